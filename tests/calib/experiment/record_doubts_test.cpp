// Records whose numbers cannot be mended, and that must not pass for good ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const test::TensileTruth sound_bar{.strain_rate = 2e-5};

RawTest without_rows(RawTest raw, std::size_t first, std::size_t last) {
  for (auto* channel : {&raw.time, &raw.force, &raw.strain, &raw.extension, &raw.stress})
    channel->erase(channel->begin() + static_cast<std::ptrdiff_t>(first),
                   channel->begin() + static_cast<std::ptrdiff_t>(last));
  return raw;
}

// The rows from 0.8 of the strength to the break are lost: 48 MPa of 60.
TEST(RecordDoubts, NamesAGapInWhichTheSpecimenBroke) {
  const RawTest whole = record(sound_bar);
  const std::size_t rows = whole.rows() - 5;
  EXPECT_THAT(test::reduced(whole).warnings, Not(Contains(HasSubstr("lie before the break"))));
  const MeasuredTest test = test::reduced(without_rows(whole, rows * 4 / 5, rows));
  EXPECT_NEAR(test.strength, 0.8 * sound_bar.strength, 0.01 * sound_bar.strength);
  EXPECT_THAT(test.warnings, Contains(HasSubstr("may have risen by 12")));
  const MeasuredTest earlier = test::reduced(without_rows(whole, rows / 2, rows * 4 / 5));
  EXPECT_THAT(earlier.warnings, Not(Contains(HasSubstr("lie before the break"))));
}

// By its crosshead: at half of the strength it slides until a third of the load is lost.
TEST(RecordDoubts, NamesALoadThatFallsWhileTheSpecimenIsStretchedOn) {
  for (const bool slides : {false, true}) {
    RawTest raw = record(sound_bar);
    const std::size_t half = (raw.rows() - 5) / 2;
    const RawTest part = without_rows(record(sound_bar), 0, half * 2 / 3);
    raw = without_rows(raw, half, raw.rows());
    for (std::size_t i = 0; i < part.rows(); ++i) {
      raw.time.push_back(raw.time.back() + sound_bar.sampling);
      raw.force.push_back(part.force[i]);
      raw.stress.push_back(part.stress[i]);
      raw.extension.push_back(part.extension[i] + (slides ? raw.extension[half / 3] : 0.0));
    }
    raw.strain.clear();
    const MeasuredTest test = test::reduced(raw);
    EXPECT_NEAR(test.failure_strain, (slides ? 7.0 / 6.0 : 1.0) * sound_bar.failure_strain(), 2e-5);
    const auto named =
        Contains(HasSubstr("MPa and grows again, while the strain does not go back"));
    if (slides)
      EXPECT_THAT(test.warnings, named);
    else
      EXPECT_THAT(test.warnings, Not(named));
  }
}

TEST(RecordDoubts, NamesALoadThatStaysInTheFewRowsAfterTheBreak) {
  RawTest raw = record(sound_bar);
  raw.stress.clear();
  for (double& force : raw.force) force += 0.04 * sound_bar.strength * sound_bar.area();
  EXPECT_THAT(test::reduced(raw).warnings,
              Contains(HasSubstr("after the break the load stays at 3.6 MPa")));
}

// A record that ends with the break has no rows after it that would tell.
TEST(RecordDoubts, NamesALoadThatBeginsBelowZero) {
  const auto named = Contains(HasSubstr("the load begins at "));
  for (const double offset : {0.0, -0.02, -0.04, -0.25}) {
    test::TensileTruth truth = sound_bar;
    truth.rows_after_break = 1;
    RawTest raw = record(truth);
    raw.stress.clear();
    for (double& force : raw.force) force += offset * truth.strength * truth.area();
    const MeasuredTest test = test::reduced(raw);
    if (offset < -0.03)
      EXPECT_THAT(test.warnings, named) << offset;
    else
      EXPECT_THAT(test.warnings, Not(named)) << offset;
  }
}

}  // namespace
}  // namespace havers::calib
