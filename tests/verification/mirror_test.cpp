// The same specimen in the mirror, its joints in another order: the same sequence of breaks. In
// time the held corner would have to be mirrored too: reordered_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

enum class Axis { along, across };  // of the mirror: y or x changes its sign

// θ and a slenderness with which the pattern at −θ is the mirror image of that at θ.
struct Pattern {
  const char* name;
  double cosine;  // of θ
  int layers, fibres;
  double slenderness;  // L/l
  Axis mirror;
};
const double steep = 2.0 * std::sqrt(6.0);  // 7 layers at cos θ = 5/7 are one fibre length high
const Pattern patterns[] = {{"StraightUpsideDown", 1.0, 5, 4, 10.0, Axis::along},
                            {"StraightBackToFront", 1.0, 6, 4, 10.0, Axis::across},
                            {"At44DegreesUpsideDown", 5.0 / 7.0, 7, 5, steep, Axis::along}};

class Mirror : public testing::TestWithParam<Pattern> {
 protected:
  Mirror() {
    const Pattern& pattern = GetParam();
    scene.assembly.layers = pattern.layers;
    scene.assembly.fibres = pattern.fibres;
    scene.assembly.fibre_height = scene.assembly.fibre_length / pattern.slenderness;
    scene.assembly.orientation = std::acos(pattern.cosine);
    image = scene;
    image.assembly.orientation *= -1.0;
    scene.joints.thresholds = draw_thresholds(scene, assembly());
    const std::vector<std::size_t> places = images();
    image.joints.thresholds.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      image.joints.thresholds[places[i]] = scene.joints.thresholds[i];
  }

  [[nodiscard]] Assembly assembly() const {
    return build_assembly(scene.assembly, scene.loading.lateral);
  }

  // Where each joint is in the mirror image.
  [[nodiscard]] std::vector<std::size_t> images() const {
    const Assembly one = assembly(), two = build_assembly(image.assembly, image.loading.lateral);
    std::vector<std::size_t> places;
    for (const Joint& joint : one.joints) {
      Eigen::Vector2d place = joint.position;
      if (GetParam().mirror == Axis::along)
        place.y() = one.height - place.y();
      else
        place.x() = one.width - place.x();
      std::size_t at = 0;
      while (at < two.joints.size() && (two.joints[at].position - place).norm() > 1e-12) ++at;
      EXPECT_LT(at, two.joints.size()) << "the image is another pattern";
      places.push_back(std::min(at, two.joints.size() - 1));
    }
    EXPECT_EQ(one.joints.size(), two.joints.size());
    return places;
  }

  void expect_mirrored(const Simulation& one, const Simulation& other) const {
    EXPECT_TRUE(one.trusted()) << one.why_not_trusted();
    EXPECT_NEAR(other.strength / one.strength, 1.0, 1e-9);
    EXPECT_NEAR(other.failure_strain / one.failure_strain, 1.0, 1e-9);
    ASSERT_EQ(one.curve.size(), other.curve.size());
    for (std::size_t i = 0; i < one.curve.size(); ++i)
      EXPECT_NEAR(one.curve[i].stress_right, other.curve[i].stress_right, 1e-8 * one.strength);
    expect_same_breaks(one, other);
  }

  // Of each joint of one and its image in the other, which may be the same run.
  void expect_same_breaks(const Simulation& one, const Simulation& other) const {
    const std::vector<std::size_t> places = images();
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(one.joints[i].broken, other.joints[places[i]].broken) << "joint " << i;
      if (one.joints[i].broken && other.joints[places[i]].broken) {
        EXPECT_NEAR(one.joints[i].broken_at_strain, other.joints[places[i]].broken_at_strain,
                    1e-9 * one.failure_strain);
      }
    }
  }

  Scene scene = test::small_scene(), image;
};
INSTANTIATE_TEST_SUITE_P(Pattern, Mirror, testing::ValuesIn(patterns),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Mirror, BreaksInMirroredPlaces) {
  const Simulation one = simulate(scene);
  EXPECT_GT(one.broken_joints, 1);
  expect_mirrored(one, simulate(image));
}

// d = 0: joints break together, and none is first for being first in the list.
TEST_P(Mirror, BreaksEqualJointsTogether) {
  for (Scene* both : {&scene, &image}) {
    both->joints.thresholds.clear();
    both->joints.scatter = 0.0;
  }
  const Simulation one = simulate(scene);
  EXPECT_GT(one.broken_joints, 1);
  expect_mirrored(one, simulate(image));
}

// Thresholds that are their own mirror image: what breaks on one side breaks on the other.
class SymmetricPattern : public Mirror {};
INSTANTIATE_TEST_SUITE_P(Pattern, SymmetricPattern, testing::Values(patterns[0], patterns[1]),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(SymmetricPattern, BreaksSymmetrically) {
  const std::vector<std::size_t> places = images();
  for (std::size_t i = 0; i < places.size(); ++i)
    scene.joints.thresholds[std::max(i, places[i])] =
        scene.joints.thresholds[std::min(i, places[i])];
  const Simulation run = simulate(scene);
  EXPECT_TRUE(run.trusted()) << run.why_not_trusted();
  EXPECT_GT(run.broken_joints, 1);
  expect_same_breaks(run, run);
}

}  // namespace
}  // namespace havers::sim
