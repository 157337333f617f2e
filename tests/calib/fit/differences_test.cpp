#include "calib/fit/differences.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// A trail whose best point is the one it begins at.
struct Begun {
  Begun(const Study& study, const Simulator& simulator, const Point& point)
      : problem(make_problem(study)), batch(simulator, nullptr, 1), trail(problem, batch, nobody) {
    const auto start = predict(problem, batch, {point}, study.calibrate.replicates).front();
    const std::vector<Landmarks> none(study.specimens.size(), Landmarks(Landmarks::Zero()));
    trail.restart(weigh(problem, start, none, Landmarks::Zero()), start);
  }

  FitProblem problem;
  SimulationBatch batch;
  CalibrationObserver nobody;
  Trail trail;
};

// The trail's best point is where the slopes are asked for; it is needed again where a side fails.
TEST(Differences, StayWhereTheyWereAskedForWhenABetterPointTurnsUp) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  const auto simulator = test::altered(
      [](Response& response, const sim::Scene& scene) {
        response.failed = scene.joints.head_tail > 60.5e6;
      },
      {.quasi_static = false});
  Begun begun(study, simulator, Eigen::Vector2d(std::log(13.0), std::log(60.0)));
  Trail& trail = begun.trail;

  const Evaluation here = trail.best();
  const auto slopes = differentiate(trail, trail.best(), {0, 1}, slope_step);
  EXPECT_LT(trail.best().cost, here.cost);
  trail.restart(trail.weights(), here);
  const auto expected = differentiate(trail, here, {0, 1}, slope_step);
  ASSERT_FALSE(slopes.failed);
  EXPECT_EQ(slopes.jacobian, expected.jacobian);
}

// Replicates that answer each in its own way, and a stopped test whose bound stays true: no noise
// of its may hide what the other tells.
TEST(Differences, HaveNoNoiseWhereABoundIsNotContradicted) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"head_tail_MPa"};
  study.specimens[1].broke = false;
  study.specimens[1].test = test::straight_test(14e9, 20e6);
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [](const sim::Scene& scene) {
    auto other = scene;
    other.joints.seed += static_cast<std::uint64_t>(scene.joints.head_tail);
    return test::ClosedForm{}(other);
  };
  simulator.quasi_static = [](const sim::Scene&) { return false; };
  Begun begun(study, simulator, Point::Constant(1, std::log(60.0)));
  const auto slopes = differentiate(begun.trail, begun.trail.best(), {0}, slope_step);
  ASSERT_FALSE(slopes.failed);
  EXPECT_GT(slopes.variance(strength, 0), 0.0);
  EXPECT_EQ(slopes.variance(landmark_count + strength, 0), 0.0);
  EXPECT_EQ(slopes.jacobian(landmark_count + strength, 0), 0.0);
}

// Some fail on one side only.
TEST(Differences, DivideTheVarianceOfEachSideByItsOwnReplicates) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"head_tail_MPa"};
  study.calibrate.replicates = 16;
  auto simulator = test::ClosedForm{.quasi_static = false}.simulator();
  simulator.run = [](const sim::Scene& scene) {
    auto other = scene;
    other.joints.seed += static_cast<std::uint64_t>(scene.joints.head_tail);
    auto response = test::ClosedForm{}(other);
    response.failed = scene.joints.head_tail > 60e6 && scene.joints.seed % 4 == 0;
    return response;
  };
  const Point point = Point::Constant(1, std::log(60.0));
  Begun begun(study, simulator, point);
  const auto slopes = differentiate(begun.trail, begun.trail.best(), {0}, slope_step);
  ASSERT_FALSE(slopes.failed);
  const auto sides = predict(begun.problem, begun.batch,
                             moved_points(begun.problem.unknowns, point, {0}, slope_step), 16);
  const double span = (sides[1].point - sides[0].point).norm();
  double expected = 0.0;
  int failed = 0;
  for (const std::size_t f : {0U, 1U}) {
    const auto &low = sides[0].predictions[f], &high = sides[1].predictions[f];
    const Landmarks& sd = begun.trail.weights().sd[f];
    const Landmarks slope = slopes_of_residuals(low, begun.problem.targets[f], sd) / (span * sd);
    expected +=
        ((low.sd.square() / low.usable + high.sd.square() / high.usable) * slope.square()).sum();
    failed += high.failed();
    EXPECT_EQ(low.failed(), 0);
  }
  EXPECT_GT(failed, 0);
  EXPECT_NEAR(slopes.independent, expected, 1e-9 * expected);
}

}  // namespace
}  // namespace havers::calib
