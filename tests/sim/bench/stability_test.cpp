#include "sim/bench/stability.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

TEST(Stability, HasFortyScenesOfDistinctNames) {
  const std::vector<StabilityScene> scenes = stability_scenes();
  EXPECT_GE(scenes.size(), 40U);
  std::set<std::string> names;
  for (const StabilityScene& scene : scenes) names.insert(scene.name);
  EXPECT_EQ(names.size(), scenes.size());
  EXPECT_TRUE(names.contains("h c/L = 1e+06")) << "with its sign a page typesets it";
}

TEST(Stability, EverySceneIsSolvedOrRefusedAsItMust) {
  HAVERS_SLOW;
  StabilityBench bench{.complete = true};
  for (const StabilityScene& scene : stability_scenes()) {
    const StabilityResult result = run_stability_scene(scene);
    EXPECT_NE(result.outcome, StabilityOutcome::wrong) << result.name << ": " << result.reason;
    EXPECT_EQ(result.outcome == StabilityOutcome::refused, scene.refused) << result.name;
    EXPECT_TRUE(result.as_it_must) << result.name << ": " << result.reason;
    EXPECT_EQ(result.reason.empty(), result.outcome == StabilityOutcome::solved) << result.name;
    bench.scenes.push_back(result);
  }
  EXPECT_TRUE(bench.good());
  const std::string all = std::to_string(bench.scenes.size());
  EXPECT_EQ(summary(bench), all + " of " + all + " scenes solved or refused as they must be.");
  bench.complete = false;
  bench.scenes.pop_back();
  EXPECT_FALSE(bench.good()) << "those left may not be as they must";
  EXPECT_TRUE(summary(bench).starts_with("Stopped"));
}

// The uniform stress, which the limit knows, stands in for what it has solved for, but not here.
TEST(Stability, ScenesInTheLimitAreSolvedAsWellWithNothingLeftOut) {
  HAVERS_SLOW;
  for (StabilityScene scene : stability_scenes()) {
    if (scene.refused || scene.scene.solver.regime != Regime::quasi_static) continue;
    scene.scene.solver.leave_out = false;
    const StabilityResult result = run_stability_scene(scene);
    EXPECT_TRUE(result.as_it_must) << result.name << ": " << result.reason;
  }
}

TEST(Stability, CallsAMissedAnswerWrong) {
  HAVERS_SLOW;
  StabilityScene scene{"stepped with a viscosity that the closed form knows",
                       test::dynamic_scene()};
  scene.scene.material.viscosity = 1e-7;
  EXPECT_EQ(run_stability_scene(scene).outcome, StabilityOutcome::solved);
  scene.scene.loading.start = Start::rest;  // a shock: the stress is not uniform
  EXPECT_EQ(run_stability_scene(scene).outcome, StabilityOutcome::wrong);
}

TEST(Stability, SaysThatARunFailed) {
  StabilityScene scene{"one sweep", test::dynamic_scene()};
  scene.scene.solver.contact = ContactMethod::gauss_seidel;
  scene.scene.solver.max_iterations = 1;
  const StabilityResult result = run_stability_scene(scene);
  EXPECT_EQ(result.outcome, StabilityOutcome::failed);
  EXPECT_NE(result.reason, "");
  EXPECT_FALSE(result.as_it_must);
}

TEST(Stability, StopsWhenAskedTo) {
  const StabilityScene scene{"stopped", test::dynamic_scene()};
  EXPECT_EQ(run_stability_scene(scene, [] { return true; }).reason,
            explain(SimulationStatus::cancelled));
}

}  // namespace
}  // namespace havers::sim
