#include "calib/synthetic/laboratory_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace havers::calib {
namespace {

constexpr double stiffness = 15e9;
constexpr double broken_at = 4e-3;

// Linear up to the break, then nothing: the record of it is known row by row.
sim::Simulation brittle() {
  sim::Simulation simulation;
  simulation.modulus = stiffness;
  for (const auto& [strain, stress] :
       {std::pair{0.0, 0.0}, {broken_at, stiffness * broken_at}, {broken_at, 0.0}}) {
    sim::CurvePoint point;
    point.strain = strain;
    point.stress_right = stress;
    simulation.curve.push_back(point);
  }
  return simulation;
}

Laboratory silent() {
  Laboratory laboratory;
  laboratory.preload = laboratory.toe_strain = 0.0;
  laboratory.force_noise = laboratory.strain_noise = 0.0;
  return laboratory;
}

double standard_deviation(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (n - 1.0));
}

TEST(LaboratoryRecord, IsOfARunThatBroke) {
  sim::Simulation simulation = brittle();
  simulation.status = sim::SimulationStatus::broken;
  EXPECT_TRUE(is_test(simulation)) << simulation.why_not_trusted();
  for (const auto status : {sim::SimulationStatus::strain_limit, sim::SimulationStatus::severed}) {
    simulation.status = status;
    EXPECT_TRUE(simulation.trusted());
    EXPECT_FALSE(is_test(simulation));
  }
}

TEST(LaboratoryRecord, OfALinearCurveIsTheLineUpToTheBreak) {
  const Bar bar;
  const Laboratory laboratory = silent();
  const RawTest test = record_test(brittle(), bar, laboratory, 1);
  const double rate = strain_rate(bar, laboratory);
  const auto loaded = static_cast<std::size_t>(broken_at / (rate * laboratory.sampling)) + 1;
  ASSERT_EQ(test.rows(), loaded + static_cast<std::size_t>(laboratory.rows_after_break));
  for (std::size_t row = 0; row < loaded; ++row) {
    const double strain = rate * laboratory.sampling * static_cast<double>(row);
    EXPECT_NEAR(test.strain[row], strain, 1e-15);
    EXPECT_NEAR(test.force[row], bar.area() * stiffness * strain, 1e-9);
    EXPECT_NEAR(test.extension[row], bar.gauge_length * strain, 1e-15);
  }
  for (std::size_t row = loaded; row < test.rows(); ++row) EXPECT_EQ(test.force[row], 0.0);
}

// Slack, the loading from its beginning, slack: on a clock that shows a stated time when the
// machine's shows 0.
TEST(LaboratoryRecord, OfASecondLoggerIsOnItsOwnClock) {
  const Bar bar;
  Laboratory laboratory = silent();
  laboratory.preload = 12.0;
  laboratory.toe_strain = 1e-4;
  const RawTest machine = record_test(brittle(), bar, laboratory, 1);
  const RawTest logger = record_logger(brittle(), bar, laboratory, 1);
  const double rate = strain_rate(bar, laboratory);
  const double first_row = logger_at_first_row(brittle(), bar, laboratory);
  const double slack = laboratory.logger_rows_before * laboratory.sampling;  // until then [s]
  const double end = slack + (broken_at + laboratory.toe_strain) / rate;
  ASSERT_GT(first_row, slack);
  EXPECT_TRUE(logger.force.empty() && logger.extension.empty());
  ASSERT_EQ(logger.time.size(), static_cast<std::size_t>(end / laboratory.sampling) + 1 +
                                    static_cast<std::size_t>(laboratory.rows_after_break));
  for (std::size_t row = 0; row < logger.time.size(); ++row) {
    const double time = logger.time[row];
    EXPECT_NEAR(time, laboratory.sampling * static_cast<double>(row), 1e-12);
    const bool strained = time > slack && time < end;
    EXPECT_NEAR(logger.strain[row], strained ? rate * (time - slack) : 0.0, 1e-12) << row;
    // What the machine's own channel would hold then, which is zeroed at its first row.
    const double on_machine = time - first_row;
    if (on_machine < 0.0 || on_machine > machine.time.back() || !strained) continue;
    const auto before = static_cast<std::size_t>(on_machine / laboratory.sampling);
    if (machine.force[before + 1] == 0.0) continue;
    const double part = on_machine / laboratory.sampling - static_cast<double>(before);
    const double zeroed = (1.0 - part) * machine.strain[before] + part * machine.strain[before + 1];
    EXPECT_NEAR(logger.strain[row] - zeroed, rate * (first_row - slack), 1e-12) << row;
  }
}

TEST(LaboratoryRecord, OfASecondLoggerHasTheGaugesGainAndNoiseOfItsOwn) {
  Laboratory laboratory = silent();
  laboratory.gain_error = 1e-2;
  RawTest logger = record_logger(brittle(), {}, laboratory, 7);
  const RawTest unerring = record_logger(brittle(), {}, silent(), 7);
  const double gain = record_test(brittle(), {}, laboratory, 7).strain[20] /
                      record_test(brittle(), {}, silent(), 7).strain[20];
  EXPECT_NEAR(logger.strain[80] / unerring.strain[80], gain, 1e-12);
  laboratory = silent();
  laboratory.strain_noise = 2e-6;
  laboratory.force_noise = 0.5;
  logger = record_logger(brittle(), {}, laboratory, 7);
  const RawTest machine = record_test(brittle(), {}, laboratory, 7);
  const RawTest quiet = record_test(brittle(), {}, silent(), 7);
  std::vector<double> noise;
  double with_strain = 0.0, with_force = 0.0;  // sums of products, of standard normals
  for (std::size_t row = 0; row < logger.time.size(); ++row) {
    noise.push_back(logger.strain[row] - unerring.strain[row]);
    if (row >= machine.rows()) continue;
    with_strain += noise.back() / 2e-6 * (machine.strain[row] - quiet.strain[row]) / 2e-6;
    with_force += noise.back() / 2e-6 * (machine.force[row] - quiet.force[row]) / 0.5;
  }
  EXPECT_NEAR(standard_deviation(noise), 2e-6, 4e-7);
  const auto rows = static_cast<double>(machine.rows());
  EXPECT_LT(std::abs(with_strain), 4.0 * std::sqrt(rows));
  EXPECT_LT(std::abs(with_force), 4.0 * std::sqrt(rows));
}

// One gain for a whole test, another for the next.
TEST(LaboratoryRecord, HasChannelsThatAreCalibratedAsWellAsAsked) {
  Laboratory laboratory = silent();
  laboratory.gain_error = 1e-2;
  std::vector<double> force_gains, strain_gains;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const RawTest test = record_test(brittle(), {}, laboratory, seed);
    const RawTest unerring = record_test(brittle(), {}, silent(), seed);
    force_gains.push_back(test.force[20] / unerring.force[20]);
    strain_gains.push_back(test.strain[20] / unerring.strain[20]);
    EXPECT_NEAR(test.force[10], force_gains.back() * unerring.force[10], 1e-9);
  }
  EXPECT_NEAR(standard_deviation(force_gains), 1e-2, 1.5e-3);
  EXPECT_NEAR(standard_deviation(strain_gains), 1e-2, 1.5e-3);
}

TEST(LaboratoryRecord, StartsAtThePreloadWithStrainZeroed) {
  Laboratory laboratory = silent();
  laboratory.preload = 12.0;
  for (const double toe : {0.0, 1e-6, 2e-4}) {
    laboratory.toe_strain = toe;
    const RawTest test = record_test(brittle(), {}, laboratory, 1);
    EXPECT_NEAR(test.force.front(), 12.0, 1e-6);
    EXPECT_EQ(test.strain.front(), 0.0);
  }
}

TEST(LaboratoryRecord, LosesTheToeInTheStrain) {
  Laboratory laboratory = silent();
  laboratory.toe_strain = 1e-4;
  const Bar bar;
  const RawTest test = record_test(brittle(), bar, laboratory, 1);
  const auto peak =
      static_cast<std::size_t>(std::ranges::max_element(test.force) - test.force.begin());
  const double strain = test.force[peak] / (bar.area() * stiffness);
  EXPECT_NEAR(test.strain[peak] - strain, 1e-4, 1e-12);
  EXPECT_LT(test.force[1], 0.2 * bar.area() * stiffness * test.strain[1]);
}

TEST(LaboratoryRecord, HasTheNoiseAskedForAndTheSameForTheSameSeed) {
  Laboratory laboratory = silent();
  laboratory.sampling = 0.01;
  const RawTest clean = record_test(brittle(), {}, laboratory, 1);
  laboratory.force_noise = 0.7;
  laboratory.strain_noise = 3e-6;
  const RawTest noisy = record_test(brittle(), {}, laboratory, 1);
  std::vector<double> force, strain;
  for (std::size_t row = 0; row < clean.rows(); ++row) {
    force.push_back(noisy.force[row] - clean.force[row]);
    strain.push_back(noisy.strain[row] - clean.strain[row]);
  }
  EXPECT_NEAR(standard_deviation(force) / 0.7, 1.0, 0.1);
  EXPECT_NEAR(standard_deviation(strain) / 3e-6, 1.0, 0.1);
  EXPECT_EQ(record_test(brittle(), {}, laboratory, 1).force, noisy.force);
  EXPECT_NE(record_test(brittle(), {}, laboratory, 2).force, noisy.force);
}

// After an avalanche the quasi-static sequence goes on at a smaller strain; a crosshead cannot.
TEST(LaboratoryRecord, NeverGoesBackWhereTheCurveDoes) {
  sim::Simulation simulation = brittle();
  simulation.curve.resize(2);
  for (const auto& [strain, stress] : {std::pair{2e-3, 1e6}, {6e-3, 5e6}}) {
    sim::CurvePoint point;
    point.strain = strain;
    point.stress_right = stress;
    simulation.curve.push_back(point);
  }
  const Bar bar;
  const RawTest test = record_test(simulation, bar, silent(), 1);
  EXPECT_TRUE(
      std::ranges::is_sorted(test.strain.begin(), test.strain.end() - silent().rows_after_break));
  const auto after =
      std::ranges::find_if(test.strain, [](double strain) { return strain > broken_at; });
  const auto row = static_cast<std::size_t>(after - test.strain.begin());
  EXPECT_NEAR(test.force[row], bar.area() * (1e6 + 1e9 * (test.strain[row] - 2e-3)), 1e-9);
}

TEST(SyntheticSpecimens, HaveSeedsOfTheirOwn) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t study = 1; study <= 10; ++study)
    for (std::uint64_t specimen = 0; specimen < 10; ++specimen)
      seeds.insert(specimen_seed(study, specimen));
  EXPECT_EQ(seeds.size(), 100U);
}

TEST(SyntheticSpecimens, VaryInModulusByTheCoefficientAskedFor) {
  std::vector<double> factors;
  for (std::uint64_t seed = 0; seed < 20000; ++seed)
    factors.push_back(modulus_variation(seed, 0.1));
  EXPECT_NEAR(std::accumulate(factors.begin(), factors.end(), 0.0) / 20000.0, 1.0, 0.003);
  EXPECT_NEAR(standard_deviation(factors), 0.1, 0.003);
  EXPECT_EQ(modulus_variation(5, 0.0), 1.0);
}

}  // namespace
}  // namespace havers::calib
