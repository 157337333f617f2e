// Which number stands in which column of the tables of simulations, sweeps and benches.
#include <gmock/gmock.h>

#include <numbers>

#include "reports/bench_pages.hpp"
#include "reports/pages.hpp"
#include "reports/sweep/sweep_page.hpp"
#include "tests/reports/sound_page.hpp"
#include "tests/reports/without_gnuplot.hpp"

namespace havers::reports {
namespace {

using test::table_rows;
using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::StartsWith;

class BenchTables : public testing::Test {
 private:
  const test::WithoutGnuplot tables_alone_;
};

TEST_F(BenchTables, TellWhatASimulationGave) {
  const sim::Assembly assembly =
      sim::build_assembly({.layers = 6, .fibres = 4}, sim::Lateral::free);
  sim::Simulation simulation = test::simulation_sample(assembly);
  simulation.strength_over_a_wave = 37e6;
  const auto rows = table_rows(simulation_page({{}, assembly, simulation, {}}));
  EXPECT_THAT(rows, Contains("Strength|38.90 MPa"));
  EXPECT_THAT(rows, Contains(fmt::format("Strength without waves that ring|{:.2f} MPa",
                                         1e-6 * simulation.strength_without_ringing())));
  EXPECT_THAT(rows, Contains("Failure strain|0.3000 %"));
  EXPECT_THAT(rows, Contains("Modulus|13.00 GPa"));
  EXPECT_THAT(rows, Contains("Strain of the first break|0.2900 %"));
  EXPECT_THAT(rows, Contains("Contact iterations|5127"));
  EXPECT_THAT(rows, Contains("Time steps|400 of 20 ns"));
}

TEST_F(BenchTables, TellEveryNumberOfAScene) {
  sim::Scene scene;
  scene.assembly = {.layers = 7, .fibres = 5, .refinement = 2};
  scene.assembly.fibre_length = 80e-6;
  scene.assembly.fibre_height = 4e-6;
  scene.assembly.orientation = std::numbers::pi / 6.0;
  scene.material.young = 14e9;
  scene.material.poisson = 0.28;
  scene.material.density = 1950.0;
  scene.joints.head_tail = 60e6;
  scene.joints.flank = 12e6;
  scene.joints.scatter = 0.6;
  scene.joints.missing = 0.03;
  scene.joints.friction = 0.7;
  scene.joints.seed = 11;
  scene.loading.strain_rate = 250.0;
  scene.loading.max_strain = 0.04;
  scene.solver.tolerance = 1e-9;
  sim::Simulation simulation;
  simulation.end_fraction_used = scene.loading.end_fraction = 0.4;
  const auto rows = table_rows(simulation_page({scene, {}, simulation, {}}));
  EXPECT_THAT(rows, Contains("Assembly|7 layers of 5 fibres, 80 µm by 4 µm, at 30°, 32 triangles a "
                             "fibre"));
  EXPECT_THAT(rows, Contains(StartsWith("Material|E = 14 GPa, ν = 0.28, ρ = 1950 kg&#x2F;m³")));
  // (M6): r = 2 σ₁ l/(σ₂ L) = 2·60·4/(12·80).
  EXPECT_THAT(rows, Contains("Joints|σ₁ = 60 MPa, σ₂ = 12 MPa, r = 0.5, friction 0.7"));
  EXPECT_THAT(rows, Contains("Thresholds|uniform, scatter d = 0.6, 3 % of the joints missing, "
                             "seed 11"));
  EXPECT_THAT(rows, Contains(AllOf(StartsWith("Loading|250 1&#x2F;s"),
                                   EndsWith("up to 4 % strain, followed to 0.4 of the strength"))));
  EXPECT_THAT(rows, Contains("Tolerance|10⁻⁹"));
}

// One point of a sweep over the scatter, with a law and a finding; no two numbers are alike.
struct SmallSweep {
  calib::Sweep sweep;
  calib::SweepResult result;

  SmallSweep() {
    sweep.name = "s";
    sweep.plan.keys = {{"joints.scatter", {"0.2"}}};
    sweep.plan.seeds = 20;
    calib::SweepPoint& point = result.points.emplace_back();
    point.values = {"0.2"};
    point.numbers = {0.2};
    point.inertia_number = 0.0012;
    calib::PointSummary& summary = result.summaries.emplace_back();
    summary.runs = 20;
    summary.failed = 2;
    summary.unbroken = 1;
    const auto strength = static_cast<std::size_t>(calib::Measure::strength);
    summary.measures.at(strength) = {.n = 16, .mean = 40e6, .sd = 2e6};
    result.strengths = {{.runs = 16,
                         .weibull_modulus = 20.0,
                         .weibull_modulus_95 = {14.0, 27.0},
                         .log_likelihood_gain = 1.3}};
    calib::Law& law = result.laws.emplace_back();
    law.request = {calib::Measure::strength, {"joints.scatter"}, ""};
    law.status = calib::LawStatus::fitted;
    law.coefficients = {-10e6, 50e6};
    law.standard_errors = {1e6, 0.5e6};
    law.confidence_factor = 2.0;
    law.explained = 0.91;
    law.lack_of_fit = 1.7;
    law.lack_of_fit_p = 0.2;
    law.runs = 17;
    calib::Finding& finding = result.findings.emplace_back();
    finding.id = "F7";
    finding.claim = "falls";
    finding.outcome = calib::FindingOutcome::agrees;
    finding.value = -0.15;
    finding.low = -0.2;
    finding.high = -0.11;
    finding.asked_low = -1.0;
    finding.ground = "below 0";
    finding.runs = 15;
    finding.inertia_low = 0.0012;
    finding.inertia_high = 0.0034;
  }
};

TEST_F(BenchTables, TellWhatASweepFound) {
  const SmallSweep known;
  const auto rows = table_rows(sweep_page("t", {{"a", known.sweep, known.result}}, {}));
  EXPECT_THAT(rows, Contains("✓ agrees|F7 falls|sI = 0.0012 to 0.0034|Strength, difference: "
                             "−15.0 % (−20.0 to −11.0)asked: below 0|15"));
  EXPECT_THAT(rows,
              Contains("Strength (MPa) linear in scatter d||scatter d: −10.0 (−12.0 to −8.0); "
                       "constant: 50.0 (49.0 to 51.0)|0.910|1.70 (p = 0.20)|17"));
  // 40 ± 2/√16; 2/40 is 5 %.
  EXPECT_THAT(rows, Contains("0.2|0.0012|18|2|1|40.00 ± 0.50|5.0|20 (14 to 27)|1.3"));
}

TEST_F(BenchTables, TellHowWaysToMeasurePorosityErr) {
  calib::MethodComparison comparison;
  const calib::MethodSummary ours{calib::PorosityMethod::ours, 0.001, 0.002, 0.0004, 25e-9};
  comparison.methods.fill(ours);
  comparison.methods.front() = {calib::PorosityMethod::naive, 0.02, 0.05, 0.03, 4e-9};
  comparison.hardships = {{"noise", comparison.methods}};
  comparison.hardships.front().methods[1].worst_error = 0.07;
  comparison.trials.resize(2);
  const auto rows = table_rows(methods_page(comparison, {}));
  EXPECT_THAT(rows, Contains(to_string(calib::PorosityMethod::naive) + "|2.0|5.0|3.0|250"));
  EXPECT_THAT(rows, Contains(to_string(calib::PorosityMethod::ours) + "|0.10|0.20|0.040|40.0"));
  EXPECT_THAT(rows, Contains("noise|5.0|7.0|0.20|0.20"));
}

TEST_F(BenchTables, TellWhatAChainCosts) {
  const calib::ChainSummary chain{.chain = "a",
                                  .error = {0.01, 0.02, 0.03},
                                  .simulations = {100, 200, 300},
                                  .seconds = {1.1, 2.2, 3.3},
                                  .success = {0.9, {0.8, 0.95}}};
  const auto rows = table_rows(chains_page({{{.chain = "a"}}, {chain}}, {}));
  EXPECT_THAT(rows, Contains("a (default)|2.0 (1.0 to 3.0)|200 (100 to 300)|2.2 (1.1 to 3.3)|"
                             "90.0 (80.0 to 95.0)"));
}

TEST_F(BenchTables, TellWhatIntervalsHold) {
  calib::Coverage coverage;
  coverage.summaries = {{"0 deg", "young_GPa", 100, 90, {0.93, {0.88, 0.96}}, {0.01, 0.02, 0.04}}};
  EXPECT_THAT(table_rows(coverage_page(coverage, {})),
              Contains("0°|E|90 of 100|93.0 (88.0 to 96.0)|2.0 (1.0 to 4.0)|as promised"));
}

TEST_F(BenchTables, TellHowAKnownSceneCameOut) {
  const sim::StabilityBench bench{{{.name = "soft",
                                    .outcome = sim::StabilityOutcome::solved,
                                    .as_it_must = true,
                                    .reason = "",
                                    .residual = 2e-9,
                                    .energy_defect = 3e-10,
                                    .penetration = 4e-5,
                                    .error = 5e-6,
                                    .wall = 0.0123}},
                                  true};
  EXPECT_THAT(table_rows(stability_page(bench, {})),
              Contains("solved|soft|5.0 × 10⁻⁶|2.0 × 10⁻⁹|3.0 × 10⁻¹⁰|4.0 × 10⁻⁵|12"));
}

TEST_F(BenchTables, TellErrorAndCostOfASetting) {
  const auto all = [](double value) { return sim::BenchSpread{value, value, value, 1}; };
  sim::WorkPrecision study{.complete = true};
  study.rows = {
      {.runs = 1,
       .trusted = 1,
       .errors = {all(0.01), all(0.02), all(0.03), all(0.04), {0.05, 0.045, 0.055, 2}, all(0.06)},
       .wall = all(1.5),
       .cpu = all(2.5),
       .steps = all(800),
       .iterations = all(900),
       .same_breaks = all(7)}};
  study.cheapest = {{.quantity = "strength", .target = 0.001, .row = 0}};
  const auto rows = table_rows(work_precision_page({}, study, {}));
  EXPECT_THAT(rows, Contains(EndsWith(" (reference)|0.010|0.020|7|0.030|0.040|0.050|0.060")));
  EXPECT_THAT(rows, Contains(EndsWith("|0.050 (0.045 to 0.055)|1.50|2.50|800|900")));
  EXPECT_THAT(rows, Contains(AllOf(StartsWith("strength|0.001|"), EndsWith("|2.50"))));
}

}  // namespace
}  // namespace havers::reports
