// Numbers that no bone has, and the units that they speak of.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using test::record;
using test::reduced;
using test::TensileTruth;

TEST(UnitDoubts, SayThatNoBoneIsSoStrongWhereTheUnitOfTheForceIsWrong) {
  const TensileTruth truth;
  for (const double factor : {1e-3, 1e3}) {
    RawTest raw = record(truth);
    for (double& force : raw.force) force *= factor;
    ASSERT_EQ(reduced(raw).warnings.size(), 1U);
    EXPECT_EQ(reduced(raw).warnings[0], std::string("a strength of ") +
                                            (factor < 1.0 ? "0.06" : "60000") +
                                            " MPa is not that of compact bone (1 to 1000 MPa): "
                                            "check the units (force_unit, width_mm, thickness_mm)");
    raw.force.clear();
    for (double& stress : raw.stress) stress *= factor;
    EXPECT_TRUE(reduced(raw).warnings.back().ends_with("check the units (stress_unit)"));
  }
}

TEST(UnitDoubts, SayThatNoBoneIsSoStiffWhereTheUnitOfTheStrainIsWrong) {
  const TensileTruth truth;
  for (const double factor : {1e-2, 1e2}) {
    RawTest raw = record(truth);
    for (double& strain : raw.strain) strain *= factor;
    ASSERT_EQ(reduced(raw).warnings.size(), 1U);
    EXPECT_EQ(reduced(raw).warnings[0],
              std::string("a modulus of ") +
                  (factor < 1.0 ? "1300 GPa with a failure strain of 0.00462 %"
                                : "0.13 GPa with a failure strain of 46.2 %") +
                  " is not that of compact bone (1 to 100 GPa): check the units (strain_unit)");
  }
}

// A machine may give way ten times as much as the specimen.
TEST(UnitDoubts, LeaveRoomForTheMachineInTheModulusOfACrosshead) {
  for (const auto& [factor, warnings] : {std::pair{20.0, 1U}, {1000.0, 2U}}) {
    RawTest raw = record({});
    raw.strain.clear();
    for (double& extension : raw.extension) extension *= factor;
    const MeasuredTest test = reduced(raw);
    ASSERT_EQ(test.warnings.size(), warnings);
    EXPECT_EQ(test.warnings.back().ends_with("check the units (extension_unit, gauge_length_mm)"),
              factor == 1000.0);
  }
}

TEST(UnitDoubts, LeaveNoRoomForTheMachineInTheModulusOfAGauge) {
  for (const bool of_crosshead : {true, false}) {
    RawTest raw = record({});
    for (double& strain : raw.strain) strain *= 20.0;
    raw.crosshead_strain = of_crosshead;
    const MeasuredTest test = reduced(raw);
    ASSERT_EQ(test.warnings.size(), 1U);
    EXPECT_EQ(test.warnings[0].ends_with("check the units (strain_unit)"), !of_crosshead);
  }
}

}  // namespace
}  // namespace havers::calib
