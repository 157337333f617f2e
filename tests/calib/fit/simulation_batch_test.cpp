#include "calib/fit/simulation_batch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>

#include "tests/support/memory_store.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

std::vector<sim::Scene> scenes_with_seeds(const std::vector<unsigned>& seeds) {
  std::vector<sim::Scene> scenes;
  for (const unsigned seed : seeds) {
    scenes.emplace_back();
    scenes.back().joints.seed = seed;
  }
  return scenes;
}

TEST(SimulationBatch, AnswersInTheOrderAsked) {
  SimulationBatch batch(test::ClosedForm{}.simulator(), nullptr, 2);
  const auto scenes = scenes_with_seeds({5, 3, 9, 1, 7, 2});
  const auto answers = batch.run(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    EXPECT_NEAR(answers[i].strength, test::ClosedForm{}(scenes[i]).strength, 1e-3);
}

TEST(SimulationBatch, SimulatesEachSceneOnce) {
  std::atomic<int> runs = 0;
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [&](const sim::Scene& scene) {
    ++runs;
    return test::ClosedForm{}(scene);
  };
  SimulationBatch batch(simulator, nullptr, 2);
  auto scenes = scenes_with_seeds({1, 2, 1, 1, 2});
  batch.run(scenes);
  apply(scenes[0], "young_GPa", 20.0);  // the same in normal form
  batch.run(scenes);
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(batch.asked(), 10);
  EXPECT_EQ(batch.distinct(), 2);
}

TEST(SimulationBatch, AsksTheStoreFirst) {
  test::MemoryStore store;
  const auto scenes = scenes_with_seeds({1, 2, 3});
  SimulationBatch(test::ClosedForm{}.simulator(), &store, 1).run(scenes);
  SimulationBatch again(test::ClosedForm{}.simulator(), &store, 1);
  again.run(scenes);
  EXPECT_EQ(again.simulated(), 0);
  EXPECT_EQ(again.distinct(), 3);
}

TEST(SimulationBatch, CountsASimulatorThatThrowsOrGivesNoNumberAsFailed) {
  const auto simulator = test::altered([](Response& response, const sim::Scene& scene) {
    if (scene.joints.seed == 1) throw std::runtime_error("out of memory");
    if (scene.joints.seed == 2) response.strength = std::numeric_limits<double>::quiet_NaN();
  });
  test::MemoryStore store;
  SimulationBatch batch(simulator, &store, 1);
  const auto scenes = scenes_with_seeds({1, 2, 3});
  const auto answers = batch.run(scenes);
  EXPECT_TRUE(answers[0].failed);
  EXPECT_EQ(answers[0].why, "out of memory");
  EXPECT_TRUE(answers[1].failed);
  EXPECT_FALSE(answers[2].failed);
  EXPECT_EQ(batch.failed(), 2);
  const auto keys = batch.keys(scenes);
  EXPECT_FALSE(store.find(keys[0])) << "there may be memory the next time";
  EXPECT_TRUE(store.find(keys[1]));
}

// A full disk says nothing of the model.
TEST(SimulationBatch, PassesOnThatAStoreCannotSave) {
  class FullStore final : public EvaluationStore {
   public:
    std::optional<Response> find(const std::string&) override { return std::nullopt; }
    void save(const std::string&, const Response&) override {
      throw std::runtime_error("the disk is full");
    }
  } store;
  SimulationBatch batch(test::ClosedForm{}.simulator(), &store, 1);
  EXPECT_THROW(batch.run(scenes_with_seeds({1})), std::runtime_error);
}

// Seed 2 is stopped: 1 is kept, 3 never begins.
TEST(SimulationBatch, NeitherKeepsNorCountsASimulationThatWasStopped) {
  test::MemoryStore store;
  int runs = 0;
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [&](const sim::Scene& scene) -> std::optional<Response> {
    ++runs;
    if (scene.joints.seed == 2) return std::nullopt;
    return test::ClosedForm{}(scene);
  };
  SimulationBatch batch(simulator, &store, 1);
  const auto scenes = scenes_with_seeds({1, 2, 3});
  const auto answers = batch.run(scenes);
  EXPECT_TRUE(batch.stopped());
  EXPECT_FALSE(answers[0].failed);
  EXPECT_TRUE(answers[1].failed);
  EXPECT_TRUE(answers[2].failed);
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(batch.simulated(), 1);
  EXPECT_EQ(batch.failed(), 0);
  EXPECT_EQ(batch.distinct(), 1);
  const auto keys = batch.keys(scenes);
  EXPECT_TRUE(store.find(keys[0]));
  EXPECT_FALSE(store.find(keys[1]));
  EXPECT_FALSE(store.find(keys[2]));
}

}  // namespace
}  // namespace havers::calib
