// The first events of the quasi-static limit against an independent solver: the statics written out
// in full, and every combination of the broken joints' states tried. Status for status.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "sim/joint/cohesive_cone.hpp"
#include "sim/simulation.hpp"
#include "tests/sim/contact/enumerated_contact.hpp"
#include "tests/sim/structure/dense_structure.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The specimen at strain 1 with some joints broken.
class FullStatics {
 public:
  explicit FullStatics(const Scene& scene)
      : friction_(scene.joints.friction),
        assembly_(build_assembly(scene.assembly, scene.loading.lateral)),
        dense_(assembly_, scene.material, {0.0, 1.0}) {}

  struct Answer {
    std::vector<JointState> states;  // of the broken joints
    VectorXd reactions;              // [N/m]
    double stress = 0.0;             // [Pa]
  };
  [[nodiscard]] const Assembly& assembly() const { return assembly_; }

  // All that keep the law of broken joints (M7).
  [[nodiscard]] std::vector<Answer> answers(const std::vector<std::size_t>& broken) const {
    constexpr JointState every[] = {JointState::stick, JointState::slip_forward,
                                    JointState::slip_backward, JointState::open};
    std::vector<Answer> found;
    for (std::size_t code = 0; code < (std::size_t{1} << (2 * broken.size())); ++code) {
      std::vector<JointState> states;
      for (std::size_t i = 0; i < broken.size(); ++i)
        states.push_back(every[(code >> (2 * i)) & 3U]);
      if (auto answer = keeping_law(broken, states); answer.reactions.size() > 0)
        found.push_back(answer);
    }
    return found;
  }

 private:
  [[nodiscard]] Answer keeping_law(const std::vector<std::size_t>& broken,
                                   const std::vector<JointState>& states) const {
    const auto rows = static_cast<Index>(2 * assembly_.joints.size());
    StructureLoads loads{VectorXd::Zero(dense_.A.rows()), VectorXd::Zero(dense_.A.rows()),
                         VectorXd::Zero(rows)};
    for (const int node : assembly_.right) loads.prescribed(2 * node) = assembly_.width;
    loads.friction = VectorXd::Zero(rows / 2);
    std::vector<Held> held(assembly_.joints.size(), Held::fully);
    for (std::size_t i = 0; i < broken.size(); ++i) {
      if (states[i] == JointState::stick) continue;
      held[broken[i]] = states[i] == JointState::open ? Held::not_at_all : Held::normal;
      loads.friction(static_cast<Index>(broken[i])) = -slip_sign(states[i]) * friction_;
    }
    const test::DenseStructure::Answer solved = dense_.solve(loads, held);
    const VectorXd gaps = dense_.C * solved.displacements;
    const double force = 1e-9 * solved.reactions.lpNorm<Eigen::Infinity>();
    const double length = 1e-9 * assembly_.width;
    for (std::size_t i = 0; i < broken.size(); ++i) {
      const auto row = static_cast<Index>(2 * broken[i]);
      const double normal = solved.reactions(row), tangent = solved.reactions(row + 1);
      if (normal < -force || gaps(row) < -length ||
          std::abs(tangent) > friction_ * normal + force ||
          slip_sign(states[i]) * gaps(row + 1) < -length)
        return {};
    }
    const VectorXd on_nodes =
        dense_.K * solved.displacements - dense_.C.topRows(rows).transpose() * solved.reactions;
    double sum = 0.0;
    for (const int node : assembly_.right) sum += on_nodes(2 * node);
    return {states, solved.reactions, sum / assembly_.height};
  }

  double friction_;
  Assembly assembly_;
  test::DenseStructure dense_;
};

struct Watched {
  CurvePoint point;
  std::vector<JointOutcome> joints;
};

// Joints without the ones that broke, and the strain at which the next meets its cone.
double next_break(const std::vector<JointOutcome>& joints, const VectorXd& at_unit_strain) {
  double first = INFINITY;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].broken) continue;
    const JointLaw law = intact_law(joints[j].threshold);
    const Local r = at_unit_strain.segment<2>(static_cast<Index>(2 * j));
    const double used = std::abs(r.y()) - law.friction * r.x();
    if (used > 0.0) first = std::min(first, law.friction * law.cohesion / used);
  }
  return first;
}

class FirstEvents : public testing::TestWithParam<std::tuple<double, Lateral, unsigned>> {};
INSTANTIATE_TEST_SUITE_P(OrientationSidesAndSeed, FirstEvents,
                         testing::Combine(testing::Values(0.0, 30.0, 90.0),
                                          testing::Values(Lateral::free, Lateral::periodic),
                                          testing::Values(1U, 2U)));

TEST_P(FirstEvents, AreThoseOfTheEnumeratedStates) {
  const auto [degrees, lateral, seed] = GetParam();
  // Across the load two fibres lie side by side: one alone is gone with the first break.
  const bool across = degrees == 90.0;
  Scene scene = test::small_scene(degrees, across ? 4 : 2, across ? 1 : 2);
  scene.assembly.fibre_height = (across ? 0.5 : 0.25) * scene.assembly.fibre_length;
  scene.loading.lateral = lateral;
  scene.joints.scatter = 1.0;
  scene.joints.seed = seed;
  scene.loading.end_fraction = 0.0;
  const FullStatics statics(scene);
  std::vector<Watched> events;
  const Simulation run = simulate(
      scene,
      [&](const Progress& progress) {
        events.push_back({progress.point, progress.joints()});
      },
      [&] { return events.size() == 3; });
  int compared = 0;
  for (std::size_t e = 0; e < events.size(); ++e) {
    const Watched& now = events[e];
    std::vector<std::size_t> broken;
    VectorXd reactions(static_cast<Index>(2 * now.joints.size()));
    for (std::size_t j = 0; j < now.joints.size(); ++j) {
      if (now.joints[j].broken) broken.push_back(j);
      reactions.segment<2>(static_cast<Index>(2 * j)) << now.joints[j].reaction_normal,
          now.joints[j].reaction_tangent;
    }
    if (broken.size() > 4 || now.point.stress_right < 0.01 * run.strength) break;
    ++compared;
    const auto answers = statics.answers(broken);
    ASSERT_FALSE(answers.empty()) << "event " << e;
    double nearest = INFINITY;
    const FullStatics::Answer* truth = nullptr;
    for (const FullStatics::Answer& answer : answers) {
      const double distance = (now.point.strain * answer.reactions - reactions).norm();
      if (distance < nearest) truth = &answer;
      nearest = std::min(nearest, distance);
    }
    EXPECT_LT(nearest, 1e-9 * now.point.strain * truth->reactions.norm()) << "event " << e;
    EXPECT_NEAR(now.point.stress_right / (now.point.strain * truth->stress), 1.0, 1e-9);
    if (e + 1 < events.size()) {
      EXPECT_NEAR(std::max(now.point.strain, next_break(now.joints, truth->reactions)),
                  events[e + 1].point.strain, 1e-9 * now.point.strain);
    }
  }
  EXPECT_GE(compared, degrees == 30.0 ? 1 : 3) << "what bears nothing is not compared";
}

}  // namespace
}  // namespace havers::sim
