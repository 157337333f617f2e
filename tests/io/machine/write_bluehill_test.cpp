// Tests as they are written: what was recorded, and read back the same.
#include <gtest/gtest.h>

#include "io/input_error.hpp"
#include "io/machine/read_test.hpp"
#include "tests/support/machine_files.hpp"

namespace havers::io {
namespace {

using test::TemporaryFile;

TEST(WriteBluehill, IsReadBack) {
  const calib::RawTest raw = test::record({.strength = 2e9, .preload = 10.0, .strain_noise = 2e-6});
  const TemporaryFile file("");
  write_bluehill(file.path(), raw);
  const TestFile back = read_test(file.path());
  EXPECT_EQ(back.layout, "Bluehill raw data");
  EXPECT_EQ(back.test.specimen_id, raw.specimen_id);
  EXPECT_DOUBLE_EQ(back.test.width.value(), raw.width.value());
  ASSERT_EQ(back.rows, raw.rows());
  EXPECT_GT(back.test.force.back(), 100.0);  // thousands marks were on the way
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    EXPECT_NEAR(back.test.time[i], raw.time[i], 0.51e-5);
    EXPECT_NEAR(back.test.force[i], raw.force[i], 0.51e-5);
    EXPECT_NEAR(back.test.extension[i], raw.extension[i], 0.51e-8);
    EXPECT_NEAR(back.test.strain[i], raw.strain[i], 0.51e-7);
    EXPECT_NEAR(back.test.stress[i], raw.stress[i], 51.0);
  }
  EXPECT_TRUE(back.test.warnings.empty());
}

// Nanoseconds in seconds take more than Bluehill's five decimals.
TEST(WriteBluehill, KeepsTheTimesOfAFastTest) {
  calib::RawTest raw = test::record({});
  for (std::size_t i = 0; i < raw.rows(); ++i) raw.time[i] = 5e-9 * static_cast<double>(i);
  const TemporaryFile file("");
  write_bluehill(file.path(), raw);
  const TestFile back = read_test(file.path());
  ASSERT_EQ(back.test.time.size(), raw.time.size());
  for (std::size_t i = 0; i < raw.time.size(); ++i)
    EXPECT_NEAR(back.test.time[i], raw.time[i], 0.51e-10);
}

TEST(WriteBluehill, WritesOnlyWhatWasRecordedWithCrLfAndThousands) {
  const TemporaryFile file("");
  calib::RawTest raw;
  raw.force = {999.0, 1234.5};
  raw.specimen_id = "A1";
  write_bluehill(file.path(), raw);
  EXPECT_EQ(test::contents(file.path()),
            "Specimen ID,\"A1\"\r\n\r\nLoad\r\n(N)\r\n\"999.00000\"\r\n\"1,234.50000\"\r\n");
  EXPECT_THROW(write_bluehill(file.path().parent_path(), raw), InputError);
}

}  // namespace
}  // namespace havers::io
