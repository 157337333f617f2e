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
        SimulationStatus::severed, SimulationStatus::not_determined,
        SimulationStatus::not_converged, SimulationStatus::not_finite,
        SimulationStatus::cancelled}) {
    words.insert(to_string(status));
    sentences.insert(explain(status));
  }
  EXPECT_THAT(words, testing::ElementsAre("broken", "cancelled", "not_converged", "not_determined",
                                          "not_finite", "severed", "step_limit", "strain_limit"));
  EXPECT_EQ(sentences.size(), 8U);
  EXPECT_THAT(explain(SimulationStatus::strain_limit), HasSubstr("lower bound"));
}

// What helps depends on what was asked for.
TEST(Simulation, SaysWhatMayHelpWhereAStepHasNoAnswer) {
  Simulation simulation;
  simulation.status = SimulationStatus::not_converged;
  simulation.step_error.reset();
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("; a shorter step_s may have one"));
  simulation.contact = ContactMethod::gauss_seidel;
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("; more max_iterations, contact"));
  simulation.regime = Regime::quasi_static;
  EXPECT_EQ(simulation.why_not_trusted(), explain(SimulationStatus::not_converged));
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
  simulation.residual_to_strength = 1e-8;
  EXPECT_TRUE(simulation.trusted());
  simulation.residual_to_strength = 2e-8;
  EXPECT_FALSE(simulation.trusted());
  simulation.status = SimulationStatus::severed;  // it bears nothing, however its pieces lie
  EXPECT_TRUE(simulation.trusted());
  simulation.status = SimulationStatus::broken;
  simulation.residual_to_strength = 0.0;
  EXPECT_TRUE(simulation.trusted());
  simulation.worst_residual = 5e-4;
  EXPECT_TRUE(simulation.trusted());
  simulation.worst_residual = 2e-3;
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("after the strength"));
  simulation.worst_residual = 0.0;
  simulation.tolerance = 1e-3;  // of sweeps: joint forces may err by a tenth
  simulation.residual_to_strength = 1e-4;
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("a tolerance of 1e-6"));
  simulation.tolerance = 1e-8;
  simulation.residual_to_strength = 0.0;
  simulation.rounding_error = 2e-4;
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("too few digits"));
  simulation.rounding_error = 0.0;
  simulation.events_without_contact = 2;
  EXPECT_TRUE(simulation.trusted()) << "after the strength";
  simulation.without_contact_to_strength = 1;
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("had no solution in an event before"));
  simulation.without_contact_to_strength = 0;
  simulation.step_error = StepError{.failure_strain = 0.009};
  EXPECT_TRUE(simulation.trusted());
  simulation.step_error = StepError{.failure_strain = 0.011};
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("still changes the failure strain"));
  simulation.step_error = StepError{.strength = 0.025};
  EXPECT_TRUE(simulation.trusted());
  simulation.step_error = StepError{.strength = 0.035, .over_a_wave = 0.035};
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("still changes the strength"));
  simulation.step_error->over_a_wave = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("still changes the strength"));
  simulation.step_error->over_a_wave = 0.025;
  EXPECT_TRUE(simulation.trusted()) << "but for waves that ring";
  simulation.step_error = StepError{.failure_strain = std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("not known"));
}

// In the limit pieces that swing leave fewer digits to forces than steps in time do.
TEST(Simulation, IsNotTrustedWhereItsEnergyDoesNotCloseToWhatItsRegimeCan) {
  Simulation simulation;
  simulation.status = SimulationStatus::broken;
  const auto trusted = [&](Regime regime, double defect) {
    simulation.regime = regime;
    simulation.energy_defect = defect;
    const std::string why = simulation.why_not_trusted();
    EXPECT_TRUE(why.empty() || why == "the energy balance does not close") << why;
    return why.empty();
  };
  EXPECT_TRUE(trusted(Regime::dynamic, 0.9e-10));
  EXPECT_FALSE(trusted(Regime::dynamic, 2e-10));
  EXPECT_TRUE(trusted(Regime::quasi_static, 2e-10));
  EXPECT_TRUE(trusted(Regime::quasi_static, 0.9e-7));
  EXPECT_FALSE(trusted(Regime::quasi_static, 2e-7));
  EXPECT_FALSE(trusted(Regime::dynamic, std::numeric_limits<double>::quiet_NaN()));
}

TEST(Simulation, IsNotTrustedWhereItsStrengthIsNoNumber) {
  Simulation simulation;
  simulation.status = SimulationStatus::broken;
  for (const double none :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    simulation.strength = none;
    EXPECT_EQ(simulation.why_not_trusted(), explain(SimulationStatus::not_finite));
  }
}

// Failure at a strain of 0.004, which a constant rate reaches after 4 µs.
TEST(Simulation, IsNotTrustedWhereAStepIsATenthOfTheWayToFailure) {
  Simulation simulation;
  simulation.status = SimulationStatus::broken;
  simulation.failure_strain = 0.004;
  simulation.broken_joints = 1;
  simulation.curve = {{}, {.time = 5e-6, .strain = 0.005}};
  simulation.step = 0.099 * 4e-6;
  EXPECT_EQ(simulation.why_not_trusted(), "");
  simulation.step = 0.101 * 4e-6;
  EXPECT_THAT(simulation.why_not_trusted(),
              HasSubstr("longer than a tenth of the time to failure"));
  simulation.broken_joints = 0;
  EXPECT_EQ(simulation.why_not_trusted(), "") << "nothing failed";
}

TEST(StepInWords, TakesTheUnitThatLeavesLessThanAThousand) {
  EXPECT_EQ(step_in_words(2e-12), "2 ps");
  EXPECT_EQ(step_in_words(0.9994e-9), "999 ps");
  EXPECT_EQ(step_in_words(0.9996e-9), "1 ns");
  EXPECT_EQ(step_in_words(0.9997e-6), "1 µs");
  EXPECT_EQ(step_in_words(0.9994e-3), "999 µs");
  EXPECT_EQ(step_in_words(0.9996e-3), "1 ms");
  EXPECT_EQ(step_in_words(0.9996), "1 s");
  EXPECT_EQ(step_in_words(12.0), "12 s");
}

TEST(Simulation, IsTrustedButForAStepThatWasGiven) {
  Simulation simulation;
  simulation.status = SimulationStatus::broken;
  simulation.step = 2e-8;
  EXPECT_EQ(simulation.reservation(), "");
  simulation.step_error.reset();
  EXPECT_TRUE(simulation.trusted());
  EXPECT_EQ(simulation.reservation(), "the time step: 20 ns was given, and its error is not known");
  simulation.numerical_loss = 0.48;
  EXPECT_THAT(simulation.reservation(), HasSubstr("known; steps took 48 % of all energy"));
  EXPECT_EQ(simulation.error_beyond_accuracy().largest(), 0.0);
}

TEST(Simulation, IsTrustedButForWavesInItsStrength) {
  Simulation simulation;
  simulation.status = SimulationStatus::broken;
  simulation.strength = 52.1e6;
  EXPECT_EQ(simulation.reservation(), "") << "in the limit there are none";
  simulation.ringing = 0.009;
  EXPECT_EQ(simulation.reservation(), "");
  simulation.ringing = 0.042;
  EXPECT_TRUE(simulation.trusted());
  EXPECT_EQ(simulation.reservation(),
            "the strength: waves that ring, which steps and meshes change, raise it by 4.2 %, "
            "from 50 MPa, its mean over the period of the longest and what the modulus adds in "
            "half of it");
  simulation.step = 2e-8;
  simulation.step_error.reset();
  EXPECT_THAT(simulation.reservation(), HasSubstr("is not known; the strength: waves"));
}

TEST(Simulation, IsTrustedButForTheModulusOfAShock) {
  Simulation simulation;
  simulation.status = SimulationStatus::broken;
  simulation.crossings = 61.0;
  EXPECT_EQ(simulation.reservation(), "") << "less than a hundredth is not worth saying";
  simulation.crossings = 5.0;
  EXPECT_EQ(simulation.reservation(),
            "the modulus: the wave of the start, which crosses the specimen 5 times while it is "
            "measured, changes it by up to 12 %");
  simulation.crossings = 2.1;
  EXPECT_FALSE(simulation.has_modulus_of_a_shock());
  EXPECT_THAT(simulation.reservation(), HasSubstr("crosses the specimen 2.1 times"));
  simulation.crossings = 1.9;
  EXPECT_TRUE(simulation.has_modulus_of_a_shock());
  EXPECT_THAT(simulation.reservation(), HasSubstr("the modulus and the strength: they are those"));
  simulation.strength_over_a_wave = 1e6;
  EXPECT_THAT(simulation.reservation(), HasSubstr("the modulus: it is that of a shock"));
}

TEST(Simulation, KnowsWhatAChosenStepLeavesBeyondTheAccuracyAskedFor) {
  Simulation simulation;
  simulation.step_accuracy = 1e-3;
  simulation.step_error = StepError{.failure_strain = 9e-4, .strength = 0.029};
  EXPECT_EQ(simulation.error_beyond_accuracy().failure_strain, 0.0);
  EXPECT_EQ(simulation.error_beyond_accuracy().strength, 0.029);
  EXPECT_EQ(simulation.reservation(), "");
}

TEST(Simulation, SaysToWhichPartOfTheStrengthItWasFollowed) {
  Simulation simulation;
  simulation.end_fraction_used = 0.85;
  simulation.status = SimulationStatus::strain_limit;
  EXPECT_EQ(explain(simulation), explain(SimulationStatus::strain_limit));
  simulation.status = SimulationStatus::broken;
  EXPECT_EQ(explain(simulation), "after a break both sides bear less than 0.85 of the strength");
}

}  // namespace
}  // namespace havers::sim
