// Exports of real machines, where HAVERS_REAL_DATA names a folder of them: each file's own header
// says what its strength is.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "calib/experiment/measured_test.hpp"
#include "io/machine/read_test.hpp"

namespace havers::io {
namespace {

// The quoted number after a key of the header. [MPa]
double header_value(const std::filesystem::path& file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(key + ",\"")) return std::stod(line.substr(key.size() + 2));
  return 0.0;
}

TEST(RealFiles, HaveTheStrengthThatTheirHeadersState) {
  const char* folder = std::getenv("HAVERS_REAL_DATA");
  if (folder == nullptr) GTEST_SKIP() << "HAVERS_REAL_DATA is not set";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".csv") continue;
    const double stated = header_value(entry.path(), "Tensile stress at Tensile strength");
    if (stated <= 0.0) continue;
    SCOPED_TRACE(entry.path());
    ++files;
    const calib::Reduction reduction = calib::reduce_test(read_test(entry.path()).test);
    EXPECT_TRUE(reduction.problems.empty());
    EXPECT_NEAR(reduction.test.strength * 1e-6, stated, 0.0005);
    EXPECT_GT(reduction.test.modulus, 0.0);
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace havers::io
