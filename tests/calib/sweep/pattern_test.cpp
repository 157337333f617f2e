#include "calib/sweep/pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace havers::calib {
namespace {

// 4 layers of 3 fibres; all joints bonded.
struct Wall {
  sim::Assembly assembly =
      sim::build_assembly({.layers = 4, .fibres = 3, .fibre_length = 100e-6, .fibre_height = 10e-6},
                          sim::Lateral::free);
  std::vector<sim::JointOutcome> joints{assembly.joints.size()};

  void break_where(const std::function<bool(const sim::Joint&)>& chosen) {
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (chosen(assembly.joints[i])) joints[i] = {.threshold = {1.0, 1.0}, .broken = true};
  }
  [[nodiscard]] Pattern pattern() const { return pattern_of(assembly, joints); }
};

bool is_head_tail(const sim::Joint& joint) {
  return joint.kind == sim::JointKind::head_tail;
}

TEST(Pattern, OfAnIntactWallIsNothing) {
  const Pattern pattern = Wall().pattern();
  EXPECT_EQ(pattern.head_tail + pattern.flank, 0);
  EXPECT_EQ(pattern.span, 0.0);
  EXPECT_TRUE(std::isnan(pattern.linked));
}

TEST(Pattern, HeadTailJointsAloneMakeNoChain) {
  Wall wall;
  wall.break_where(is_head_tail);
  EXPECT_EQ(wall.pattern().flank, 0);
  EXPECT_EQ(wall.pattern().linked, 0.0);
  EXPECT_NEAR(wall.pattern().span, 0.25, 1e-12);  // one layer of four
}

TEST(Pattern, ASteppedCrackSpansTheHeight) {
  Wall wall;
  wall.break_where([](const sim::Joint& joint) {  // between 100 and 150 µm
    return joint.position.x() > 95e-6 && joint.position.x() < 155e-6;
  });
  EXPECT_EQ(wall.pattern().head_tail, 4);
  EXPECT_EQ(wall.pattern().flank, 3);
  EXPECT_EQ(wall.pattern().linked, 1.0);
  EXPECT_NEAR(wall.pattern().span, 1.0, 1e-12);
}

}  // namespace
}  // namespace havers::calib
