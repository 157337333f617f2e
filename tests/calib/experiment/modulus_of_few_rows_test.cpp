// Windows of the modulus whose halves have too few rows to tell a bend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using test::detail_of;
using test::record;
using test::reduced;
using test::TensileTruth;

// What follows the window is steeper, as after a gentle toe, but of too few rows for the halves
// that would show whether it is straight: it was no toe that was seen.
TEST(ModulusOfFewRows, LeavesTheWindowWhereWhatFollowsDoesNotTell) {
  const TensileTruth truth{.strength = 100e6};
  for (const std::size_t rows : {17U, 60U}) {
    RawTest raw = record(truth);
    raw.stress.clear();
    for (auto* channel : {&raw.time, &raw.force, &raw.extension, &raw.strain})
      channel->resize(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(rows - 1);
      raw.time[i] = static_cast<double>(i);
      raw.force[i] = part * truth.strength * truth.area();
      raw.strain[i] = raw.extension[i] =
          truth.failure_strain() * (std::min(part, 0.4) + std::max(part - 0.4, 0.0) / 1.08);
    }
    EXPECT_EQ(detail_of(reduced(raw, {.remove_toe = false}), "modulus window"),
              rows > 20
                  ? "moved from 0.1-0.4 to 0.4-0.9 of the strength, where the curve is straight"
                  : "");
  }
}

// A power of the strain, whose slope has no end of growing: with the last rows of a window that is
// narrowed nobody can tell, and what its larger part differed by stays an error.
TEST(ModulusOfFewRows, CountsTheCurvatureThatTheyDoNotShow) {
  const TensileTruth truth{.strength = 150e6};
  for (const auto& [power, rows] : {std::pair{1.3, 50}, {1.3, 100}, {1.5, 50}, {1.5, 100}}) {
    RawTest raw;
    raw.area = truth.area();
    for (int i = 0; i < rows; ++i) {
      const double part = i / (rows - 1.0);
      raw.strain.push_back(0.01 * part);
      raw.force.push_back(std::pow(part, power) * truth.strength * truth.area());
    }
    const MeasuredTest test = reduced(raw);
    const double steepens = (power - 1.0) / power * std::log(0.375 / 0.325);  // of 0.3-0.4
    EXPECT_GT(test.modulus_standard_error, 0.9 * steepens * test.modulus) << power << ", " << rows;
    EXPECT_NE(detail_of(test, "modulus window").find("too few rows are left to tell a bend"),
              std::string::npos)
        << power << ", " << rows;
  }
}

}  // namespace
}  // namespace havers::calib
