// Machines that write tension negative, and specimens that are compressed.
#include <gtest/gtest.h>

#include <string>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using test::record;
using test::reduced;

std::string refusal(const RawTest& raw) {
  const Reduction reduction = reduce_test(raw);
  return reduction.problems.empty() ? "none" : reduction.problems.front();
}

// With or without a gauge, and noise about zero.
TEST(LoadSign, TurnsTensionThatAMachineWritesNegative) {
  for (const double noise : {0.0, 0.1})
    for (const bool gauge : {true, false}) {
      RawTest raw = record({.force_noise = noise});
      if (!gauge) raw.strain.clear();
      const MeasuredTest positive = reduced(raw);
      for (std::vector<double>* channel : {&raw.force, &raw.stress})
        for (double& value : *channel) value = -value;
      const MeasuredTest turned = reduced(raw);
      EXPECT_EQ(turned.stress, positive.stress);
      EXPECT_EQ(turned.modulus, positive.modulus);
      EXPECT_TRUE(turned.load_turned && !positive.load_turned);
      ASSERT_EQ(turned.warnings.size(), positive.warnings.size() + 1);
      EXPECT_EQ(turned.warnings.front(),
                "the force is negative while the specimen gets longer: it is taken as tension, "
                "with its sign turned");
    }
}

// With or without noise about zero, which makes a little tension of it.
TEST(LoadSign, SaysThatTheSpecimenIsCompressed) {
  for (const double noise : {0.0, 0.1}) {
    RawTest raw = record({.force_noise = noise});
    for (std::vector<double>* channel : {&raw.force, &raw.stress, &raw.strain})
      for (double& value : *channel) value = -value;
    EXPECT_TRUE(refusal(raw).starts_with("the force is negative, as in compression, down to -"))
        << refusal(raw);
    raw.force.clear();
    EXPECT_TRUE(
        refusal(raw).ends_with(" MPa, and the specimen gets no longer: only tension can be used; "
                               "where the file counts tension negative, change the signs of its "
                               "columns"))
        << refusal(raw);
  }
}

}  // namespace
}  // namespace havers::calib
