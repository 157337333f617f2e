#include "calib/sweep/measure.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace havers::calib {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::IsNan;

// Straight up to half the failure strain, then below the line of the modulus; a short fall.
Response bent_response() {
  return {.failed = false,
          .broke = true,
          .why = "",
          .modulus = 13e9,
          .strength = 100e6,
          .failure_strain = 0.01,
          .strain = {0.0, 0.005, 0.01, 0.012},
          .stress = {0.0, 65e6, 100e6, 2e6}};
}

const Pattern four_numbers{.head_tail = 3, .flank = 4, .span = 0.3, .linked = 0.25};

sim::Scene scene_without_rate() {
  sim::Scene scene;
  scene.solver.regime = sim::Regime::quasi_static;
  return scene;
}

TEST(Measures, AreEachInItsPlace) {
  EXPECT_THAT(measures_of(bent_response(), scene_without_rate(), &four_numbers),
              ElementsAre(100e6, 0.01, 13e9, 0.5, DoubleNear(0.2, 1e-12), 3.0, 4.0, 0.3, 0.25));
}

TEST(Measures, AreUnknownWhereNothingTellsThem) {
  const sim::Scene scene = scene_without_rate();
  Response response = bent_response();
  EXPECT_THAT(measures_of(response, scene, nullptr),
              ElementsAre(100e6, 0.01, 13e9, 0.5, DoubleNear(0.2, 1e-12), IsNan(), IsNan(), IsNan(),
                          IsNan()));
  response.broke = false;  // nothing fell
  response.modulus = 0.0;  // no line to compare with
  EXPECT_THAT(measures_of(response, scene, &four_numbers),
              ElementsAre(100e6, 0.01, IsNan(), IsNan(), IsNan(), 3.0, 4.0, 0.3, 0.25));
  response.failed = true;
  EXPECT_THAT(measures_of(response, scene, &four_numbers), Each(IsNan()));
}

// One run of each kind: broken, broken with a reservation, unbroken, failed, of another point.
TEST(PointSummary, CountsRunsByHowTheyEndedAndTakesValuesFromThoseThatTellThem) {
  std::vector<SweepRun> runs(5);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].failed = runs[i].broke = false;
    runs[i].measures.fill(static_cast<double>(1 + i));
  }
  runs[0].broke = runs[1].broke = runs[4].broke = true;
  runs[1].why = "the step was given";
  runs[3].failed = true;
  runs[3].why = "nothing holds";
  runs[4].point = 1;
  const PointSummary summary = summary_of(runs, 0);
  EXPECT_EQ(summary.runs, 4);
  EXPECT_EQ(summary.failed, 1);
  EXPECT_EQ(summary.unbroken, 1);
  EXPECT_EQ(summary.reserved, 1);
  EXPECT_EQ(summary[Measure::strength].mean, 1.5);
  EXPECT_EQ(summary[Measure::modulus].mean, 2.0);  // that of the unbroken run counts
  EXPECT_EQ(unbroken_of(runs, {0}, Measure::strength), 1);
  EXPECT_EQ(unbroken_of(runs, {0}, Measure::modulus), 0);
  EXPECT_EQ(unbroken_of(runs, {1}, Measure::strength), 0);
}

}  // namespace
}  // namespace havers::calib
