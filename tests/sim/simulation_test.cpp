#include "sim/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

namespace havers::sim {
namespace {

using testing::HasSubstr;

TEST(SimulationStatus, HasAWordAndASentenceEach) {
  std::set<std::string> words, sentences;
  for (const SimulationStatus status :
       {SimulationStatus::broken, SimulationStatus::strain_limit, SimulationStatus::step_limit,
        SimulationStatus::not_determined, SimulationStatus::not_converged,
        SimulationStatus::not_finite, SimulationStatus::cancelled}) {
    words.insert(to_string(status));
    sentences.insert(explain(status));
  }
  EXPECT_THAT(words, testing::ElementsAre("broken", "cancelled", "not_converged", "not_determined",
                                          "not_finite", "step_limit", "strain_limit"));
  EXPECT_EQ(sentences.size(), 7U);
  EXPECT_THAT(explain(SimulationStatus::strain_limit), HasSubstr("lower bound"));
}

TEST(Simulation, IsNotTrustedUnlessItsChecksHold) {
  Simulation simulation;
  EXPECT_FALSE(simulation.trusted());  // pessimistic at first
  simulation.status = SimulationStatus::broken;
  EXPECT_TRUE(simulation.trusted());
  simulation.energy_defect = 1e-6;
  EXPECT_FALSE(simulation.trusted());
  simulation.energy_defect = 0.0;
  simulation.tolerance = 1e-8;
  simulation.worst_residual = 1e-8;
  EXPECT_TRUE(simulation.trusted());
  simulation.worst_residual = 2e-8;
  EXPECT_FALSE(simulation.trusted());
  simulation.status = SimulationStatus::severed;  // it bears nothing, however its pieces lie
  EXPECT_TRUE(simulation.trusted());
  simulation.status = SimulationStatus::broken;
  simulation.worst_residual = 0.0;
  EXPECT_TRUE(simulation.trusted());
  simulation.step_error = StepError{.strength = 0.025};
  EXPECT_TRUE(simulation.trusted());
  simulation.step_error = StepError{.strength = 0.035};
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("still changes the strength"));
  simulation.step_error = StepError{std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("not known"));
}

}  // namespace
}  // namespace havers::sim
