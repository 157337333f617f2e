// Fits that end elsewhere than at a minimum, or meet simulations that fail on the way there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "calib/fit/calibrate.hpp"
#include "calib/fit/scenes.hpp"
#include "tests/support/memory_store.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::expect_within;

TEST(Calibrate, ToleratesSimulationsThatFail) {
  const auto simulator = test::altered([](Response& response, const sim::Scene& scene) {
    if (scene.joints.seed % 10 == 0) throw std::runtime_error("no convergence");
    if (scene.joints.seed % 10 == 1) response.strength = std::numeric_limits<double>::quiet_NaN();
  });
  const auto result = calibrate_with(simulator, test::synthetic_study(test::three_orientations));
  EXPECT_EQ(result.status, CalibrationStatus::converged);
  EXPECT_GT(result.failed_simulations, 0);
  expect_within(test::parameter_of(result, "head_tail_MPa"), 60.0, 0.01);
}

// A whole region of the ratio cannot be simulated: the searches go round it.
TEST(Calibrate, ToleratesARegionThatFails) {
  const auto simulator = test::altered([](Response& response, const sim::Scene& scene) {
    response.failed = sim::ratio(scene.assembly, scene.joints) > 5.0;
  });
  const auto result = calibrate_with(simulator, test::synthetic_study(test::three_orientations));
  EXPECT_EQ(result.status, CalibrationStatus::converged);
  expect_within(test::parameter_of(result, "ratio"), 2.0, 0.03);
}

TEST(Calibrate, SaysThatEverySimulationFailed) {
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [](const sim::Scene&) -> Response { throw std::runtime_error("broken model"); };
  const auto result = calibrate_with(simulator, test::synthetic_study(test::three_orientations));
  EXPECT_EQ(result.status, CalibrationStatus::all_failed);
  EXPECT_FALSE(result.trusted());
  EXPECT_EQ(result.failed_simulations, result.distinct_simulations);
  EXPECT_EQ(std::ranges::count(result.verdict, Outcome::pass, &Check::outcome),
            std::ranges::count(result.verdict, false, &Check::done))
      << "what passes was not looked at";
  EXPECT_EQ(test::parameter_of(result, "ratio").left_out_because,
            "simulations at the answer or beside it failed");
  EXPECT_THAT(result.verdict.back().text,
              testing::HasSubstr("failed, most often so: broken model."));
  EXPECT_FALSE(result.verdict.at(2).done) << "no start is compared: " << result.verdict[2].text;
}

TEST(Calibrate, SaysThatThereIsNothingToFit) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"ratio"};
  EXPECT_EQ(test::fit(study).status, CalibrationStatus::nothing_to_fit);
  study.specimens.clear();
  EXPECT_EQ(test::fit(study).status, CalibrationStatus::nothing_to_fit);
}

// How many replicates are needed is asked of the answer; specimens are simulated without one too.
TEST(Calibrate, SimulatesEverySpecimenWhereNoReplicatesAreAskedForAndNothingIsFitted) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.replicates = replicates_by_need;
  study.calibrate.parameters = {"friction"};
  const auto uninformed = test::fit(study);
  EXPECT_EQ(uninformed.status, CalibrationStatus::nothing_to_fit);
  EXPECT_EQ(uninformed.specimens.at(1).replicates.size(), 8U);
  for (auto& specimen : study.specimens) specimen.use = Use::validate;
  const auto held_out = test::fit(study);
  EXPECT_EQ(held_out.status, CalibrationStatus::nothing_to_fit);
  EXPECT_EQ(held_out.specimens.at(1).replicates.size(), 8U);
}

TEST(Calibrate, SaysThatEverySimulationFailedWhereNoReplicatesAreAskedFor) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.replicates = replicates_by_need;
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [](const sim::Scene&) -> Response { throw std::runtime_error("broken model"); };
  const auto result = calibrate_with(simulator, study);
  EXPECT_EQ(result.status, CalibrationStatus::all_failed);
  EXPECT_EQ(result.specimens.at(1).replicates.size(), 8U);
}

TEST(Calibrate, SaysThatTheBudgetIsSpentAndKeepsTheBestPoint) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.budget = 6;
  const auto result = test::fit(study);
  EXPECT_EQ(result.status, CalibrationStatus::budget_spent);
  EXPECT_FALSE(result.trusted());
  EXPECT_LT(result.cost, 1e4);
  EXPECT_THAT(test::check_of(result, "converged").text,
              testing::EndsWith("run again into the same folder (--force), which keeps the "
                                "simulations"));
}

// The budget is one of points with eight replicates until their number is known, not of scouts.
TEST(Calibrate, HasItsWholeBudgetWhereNoReplicatesAreAskedFor) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.budget = 20;
  study.calibrate.replicates = replicates_by_need;
  const auto result = test::fit(study);
  EXPECT_EQ(result.status, CalibrationStatus::converged);
  EXPECT_GT(result.distinct_simulations, 20 * 3 * 6);
}

// Beside the answer nothing can be simulated.
TEST(Calibrate, IsNotToBeTrustedWithoutAnInterval) {
  auto study = test::synthetic_study(test::three_orientations);
  apply(study.model, "head_tail_MPa", 60.0);
  const auto simulator = test::altered(
      [](Response& response, const sim::Scene& scene) {
        response.failed = std::abs(std::log(scene.joints.head_tail / 60e6)) > 0.02;
      },
      {.quasi_static = false});
  const auto result = calibrate_with(simulator, study);
  EXPECT_EQ(result.status, CalibrationStatus::converged);
  const auto check = test::check_of(result, "converged");
  EXPECT_EQ(check.outcome, Outcome::fail) << check.text;
  EXPECT_FALSE(test::check_of(result, "identifiable").done);
  EXPECT_FALSE(test::says(test::check_of(result, "spread between specimens"), "intervals include"));
}

// The last look at the answer is not the searches' any more.
TEST(Calibrate, EndsWhereTheBudgetWouldEndOnlyItsHindsight) {
  auto study = test::synthetic_study(test::three_orientations);
  const auto whole = test::fit(study);
  const long sets = static_cast<long>(study.specimens.size()) * study.calibrate.replicates;
  study.calibrate.budget = static_cast<int>(whole.distinct_simulations / sets) - 1;
  const auto result = test::fit(study);
  EXPECT_GT(result.distinct_simulations, study.calibrate.budget * sets);
  EXPECT_EQ(result.status, CalibrationStatus::converged);
  EXPECT_EQ(result.parameters[0].interval_95, whole.parameters[0].interval_95);
}

// Scouts have three replicates of which the others tell nothing.
TEST(Calibrate, HasNoAnswerWhereAllReplicatesOfTheBestPointFail) {
  const auto study = test::synthetic_study(test::three_orientations);
  std::set<std::uint64_t> of_scouts;
  for (const auto& specimen : study.specimens)
    for (const int replicate : {0, 1, 2})
      of_scouts.insert(replicate_seed(study.calibrate.seed, specimen.id, replicate));
  for (const double around : {0.01, 10.0}) {  // the answer, in the logarithm of the ratio
    const auto simulator = test::altered([&](Response& response, const sim::Scene& scene) {
      const double away = std::log(sim::ratio(scene.assembly, scene.joints) / 2.0);
      response.failed = !of_scouts.contains(scene.joints.seed) && std::abs(away) < around;
    });
    const auto result = calibrate_with(simulator, study);
    EXPECT_EQ(result.status, CalibrationStatus::all_failed) << around;
    EXPECT_FALSE(result.trusted());
  }
}

// A point that no search came to says nothing of the model, and no interval is worth its time.
TEST(Calibrate, JudgesNothingOnceTheBudgetIsSpent) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.budget = 1;
  const auto result = test::fit(study);
  ASSERT_EQ(result.status, CalibrationStatus::budget_spent);
  for (const Check& check : result.verdict)
    EXPECT_EQ(check.done, check.check == "converged" || check.check == "simulations")
        << check.check << ": " << check.text;
  EXPECT_TRUE(result.profiles.empty());
  EXPECT_TRUE(result.next_tests.empty());
  for (const auto& parameter : result.parameters) {
    EXPECT_FALSE(parameter.identifiable) << parameter.name;
    EXPECT_NE(parameter.left_out_because.find("budget"), std::string::npos) << parameter.name;
  }
}

TEST(Calibrate, StopsWhenToldToAndGoesOnFromTheStore) {
  test::MemoryStore store;
  const auto study = test::synthetic_study(test::three_orientations);
  const auto simulator = test::ClosedForm{}.simulator();
  int calls = 0;
  const auto stopped = calibrate_with(simulator, study, &store,
                                      [&](const CalibrationProgress&) { return ++calls < 40; });
  EXPECT_EQ(stopped.status, CalibrationStatus::cancelled);
  EXPECT_EQ(calls, 40);
  const auto resumed = calibrate_with(simulator, study, &store);
  const auto whole = calibrate_with(simulator, study);
  EXPECT_EQ(resumed.cost, whole.cost);
  EXPECT_LT(resumed.simulated, whole.simulated);
}

// Ctrl-C may come inside any simulation, those of the hindsight among them.
TEST(Calibrate, StopsInsideAnySimulationAndGoesOnFromTheStore) {
  auto study = test::synthetic_study({0.0, 90.0});
  study.calibrate.replicates = 4;
  long runs = 0, last = std::numeric_limits<long>::max();
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [&](const sim::Scene& scene) -> std::optional<Response> {
    if (++runs >= last) return std::nullopt;
    return test::ClosedForm{}(scene);
  };
  const auto whole = calibrate_with(simulator, study);
  const long all = whole.simulated;
  for (long stop = 1; stop <= all; stop += stop < all - 8 ? 7 : 1) {
    test::MemoryStore store;
    runs = 0;
    last = stop;
    const auto stopped = calibrate_with(simulator, study, &store);
    EXPECT_EQ(stopped.status, CalibrationStatus::cancelled) << stop;
    EXPECT_EQ(stopped.simulated, stop - 1);
    EXPECT_EQ(stopped.failed_simulations, 0) << stop;
    EXPECT_EQ(runs, stop);  // none began after it
    last = std::numeric_limits<long>::max();
    const auto resumed = calibrate_with(simulator, study, &store);
    EXPECT_EQ(resumed.simulated, all - stop + 1);
    EXPECT_EQ(resumed.cost, whole.cost) << stop;
    EXPECT_EQ(resumed.parameters[0].interval_95, whole.parameters[0].interval_95) << stop;
  }
}

// A file that is locked for a moment: whichever search is on then, an optimiser must not make a
// failure of its own of it, after which the fit would go on.
TEST(Calibrate, EndsWithWhatTheStoreThrowsInAnySearch) {
  class LockedStore final : public EvaluationStore {
   public:
    explicit LockedStore(long saves) : saves_(saves) {}
    std::optional<Response> find(const std::string&) override { return std::nullopt; }
    void save(const std::string&, const Response&) override {
      if (saves_-- == 0) throw std::runtime_error("the file is locked");
    }

   private:
    long saves_;
  };
  auto study = test::synthetic_study({0.0, 45.0});
  study.calibrate.replicates = 4;
  for (const auto global : {GlobalSearch::starts, GlobalSearch::mlsl, GlobalSearch::direct}) {
    study.calibrate.global = global;
    const long all = test::fit(study).simulated;
    for (long saves = 0; saves < all; saves += 1 + all / 12) {
      LockedStore store(saves);
      EXPECT_THROW(calibrate_with(test::ClosedForm{}.simulator(), study, &store),
                   std::runtime_error)
          << saves << " of " << all;
    }
  }
}

// Two of three replicates fail: what the third says is no cost.
TEST(Calibrate, HasNoCostWhereNoPointHasAnAnswer) {
  const auto simulator = test::altered([](Response& response, const sim::Scene& scene) {
    response.failed = scene.joints.seed % 3 != 0;
  });
  const auto result = calibrate_with(simulator, test::synthetic_study({0.0, 90.0}));
  EXPECT_EQ(result.status, CalibrationStatus::all_failed);
  EXPECT_LT(result.failed_simulations, result.distinct_simulations);
  EXPECT_FALSE(std::isfinite(result.cost));
}

}  // namespace
}  // namespace havers::calib
