// libFuzzer target: whatever bytes a file holds, they are read or refused with an InputError.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "calib/experiment/measured_test.hpp"
#include "io/input_error.hpp"
#include "io/machine/read_test.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("havers_fuzz_" + std::to_string(getpid()) + ".csv");
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    for (havers::io::TestFile& file : havers::io::read_tests(path)) {
      file.test.area = 1e-5;
      file.test.gauge_length = 0.025;
      havers::calib::reduce_test(file.test);
    }
  } catch (const havers::io::InputError&) {  // refused: that is an answer
    return 0;
  }
  return 0;
}
