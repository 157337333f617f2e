// What figures draw: the rows that gnuplot is given, and which of their columns it takes for what.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <sstream>

#include "reports/bench_pages.hpp"
#include "reports/figures/figures.hpp"
#include "reports/sweep/sweep_figure.hpp"
#include "tests/reports/sound_page.hpp"
#include "tests/support/sweeps.hpp"

namespace havers::reports {
namespace {

using test::after;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// Rows of the data of that name.
std::vector<std::string> rows_of(const std::string& commands, const std::string& name) {
  const std::string begin = "$" + name + " << EOD\n";
  const std::size_t at = commands.find(begin);
  if (at == std::string::npos) return {};
  std::istringstream block(commands.substr(at + begin.size()));
  std::vector<std::string> rows;
  for (std::string row; std::getline(block, row) && row != "EOD";) {
    row.erase(row.find_last_not_of(' ') + 1);
    rows.push_back(row);
  }
  return rows;
}

TEST(FigureData, OfASpecimenAreItsCurvesInPercentAndMegapascals) {
  calib::SpecimenResult specimen;
  specimen.measured.strain = {0.001, 0.002};
  specimen.measured.stress = {12e6, 24e6};
  specimen.measured.failure_strain = 0.0025;
  specimen.measured.strength = 30e6;
  specimen.band.strain = {0.001, 0.002};
  specimen.band.lower = {10e6, 20e6};
  specimen.band.median = {13e6, 26e6};
  specimen.band.upper = {15e6, 30e6};
  specimen.band.residual = {1e6, 2e6};
  const std::string commands = specimen_figure(specimen, "s").commands;
  EXPECT_THAT(rows_of(commands, "measured"), ElementsAre("0.001 1.2e+07", "0.002 2.4e+07"));
  EXPECT_THAT(rows_of(commands, "band"),
              ElementsAre("0.001 1e+07 1.5e+07 1.3e+07", "0.002 2e+07 3e+07 2.6e+07"));
  EXPECT_THAT(rows_of(commands, "residual"), ElementsAre("0.001 1e+06", "0.002 2e+06"));
  EXPECT_THAT(rows_of(commands, "peak"), ElementsAre("0.0025 3e+07"));
  const std::string curve = "($1*100):($2*1e-6)";
  EXPECT_THAT(after(commands, "using ", " "),
              ElementsAre("($1*100):($2*1e-6):($3*1e-6)", curve, "($1*100):($4*1e-6)", curve, curve,
                          curve));
  // The grid from 0.1 to 0.2 %, with a margin of 2 % of it; the peak is no part of a curve.
  EXPECT_THAT(commands, HasSubstr("set xrange [0.098:0.202]\n"));
}

TEST(FigureData, OfStrengthsAreMeasuredThenSimulatedWithTheirErrors) {
  calib::SpecimenResult specimen;
  specimen.id = "A9";
  specimen.measured.strength = 40e6;
  specimen.measured.strength_standard_error = 2e6;
  specimen.strength = {45e6, 3e6};
  const std::string commands = strength_figure({specimen}, "s").commands;
  // It lies above the line of equality: its name stands on the left.
  EXPECT_THAT(rows_of(commands, "group0"), ElementsAre("4e+07 4.5e+07 2e+06 3e+06 \"\" \"A9\""));
  EXPECT_THAT(commands, AllOf(HasSubstr("($1*1e-6):($2*1e-6):($3*1e-6):($4*1e-6) with xyerrorbars"),
                              HasSubstr("set xlabel 'Measured strength (MPa)'")));
  specimen.measured.broke = false;
  // A tenth of 5 MPa would hardly be seen: a hundredth of the largest strength is the least.
  EXPECT_THAT(rows_of(strength_figure({specimen}, "s").commands, "stopped"),
              ElementsAre("40 45 0.45 0"));
}

TEST(FigureData, OfIntervalsAreValueFitAndEnds) {
  calib::Study study;
  calib::CalibrationResult one, two;
  one.parameters = {{.name = "young_GPa", .value = 13.0, .interval_95 = {12.5, 13.7}}};
  two.parameters = {{.name = "young_GPa", .value = 14.0, .interval_95 = {test::nan, 15.0}}};
  EXPECT_THAT(rows_of(intervals_figure({{study, one, {}, {}}, {study, two, {}, {}}}, "i").commands,
                      "panel0"),
              ElementsAre("13 1 12.5 13.7", "14 2 14 14"));
}

TEST(FigureData, OfProfilesAndStartsAreTheirCosts) {
  const std::string profile =
      profile_figure({{"young_GPa", {12.0, 13.0}, {2.5, 0.0}, 1.9, {}}}, "p").commands;
  EXPECT_THAT(rows_of(profile, "profile0"), ElementsAre("12 2.5", "13 0"));
  EXPECT_THAT(profile, HasSubstr("plot 1.9 with lines"));
  calib::CalibrationResult result;
  result.starts = {93.0, 178.0};
  result.ends = {91.0};
  const std::string starts = waterfall_figure(result, "w").commands;
  EXPECT_THAT(rows_of(starts, "starts"), ElementsAre("1 93", "2 178"));
  EXPECT_THAT(rows_of(starts, "ends"), ElementsAre("1 91"));
}

TEST(FigureData, OfASimulationAreItsRows) {
  sim::Assembly assembly;
  assembly.joints.resize(3);
  assembly.joints[0].kind = assembly.joints[1].kind = sim::JointKind::flank;
  assembly.joints[2].kind = sim::JointKind::head_tail;
  sim::Simulation simulation;
  simulation.numerical_loss = 0.5;
  simulation.joints.resize(3);
  for (std::size_t j = 0; j < 3; ++j) {
    simulation.joints[j] = {.threshold = {1.0, 1.0}, .broken = true};
    simulation.joints[j].broken_at_strain = 0.001 * static_cast<double>(3 - j);
  }
  simulation.curve.resize(2);
  simulation.curve[1] = {.time = 1e-6,
                         .strain = 0.004,
                         .stress_right = 51e6,
                         .stress_left = 52e6,
                         .broken_joints = 3,
                         .kinetic = 5e-3,
                         .elastic = 4e-3,
                         .dissipated = 6e-3,
                         .numerical = 7e-3};
  const std::string commands = simulation_figure({{}, assembly, simulation, {}}, "c").commands;
  EXPECT_THAT(rows_of(commands, "curve"),
              ElementsAre("0 0 0 0 0 0 0 0", "0.004 5.1e+07 5.2e+07 3 0.004 0.006 0.005 0.007"));
  EXPECT_THAT(rows_of(commands, "head_tail"), ElementsAre("0 0", "0.001 1", "0.004 1"));
  EXPECT_THAT(rows_of(commands, "flank"), ElementsAre("0 0", "0.002 1", "0.003 2", "0.004 2"));
  for (const char* curve :
       {"($1*100):($2*1e-6) with lines lw 1.8 lc rgb blue title 'right side'",
        "($1*100):($3*1e-6) with lines lw 1.4 dt 2 lc rgb orange title 'left side'",
        "($1*100):($5/0.001) with lines lw 1.8 lc rgb blue title 'elastic'",
        "($1*100):($6/0.001) with lines lw 1.8 dt 2 lc rgb red title 'dissipated'",
        "($1*100):($7/0.001) with lines lw 1.8 dt 4 lc rgb green title 'kinetic'",
        "($1*100):($8/0.001) with lines lw 1.8 dt 5 lc rgb orange title 'lost'",
        "set ylabel 'Energy (mJ/m)'", "$flank using ($1*100):2 with steps"})
    EXPECT_THAT(commands, HasSubstr(curve));
}

TEST(FigureData, OfATestAreWhatWasReadAndUsedTheLineAndTheStrength) {
  calib::RawTest raw;
  raw.strain = {0.0011, 0.0021};
  raw.force = {96.0, 192.0};
  calib::MeasuredTest test;
  test.area = 8e-6;
  test.strain = {0.001, 0.002};
  test.stress = {13e6, 25e6};
  test.modulus = 12e9;
  test.window_low = 0.0005;
  test.window_high = 0.0024;
  test.failure_strain = 0.0025;
  test.strength = 30e6;
  const Figure figure = test_figure({"A1.csv", raw, test}, "t");
  EXPECT_THAT(rows_of(figure.commands, "raw"), ElementsAre("0.0011 1.2e+07", "0.0021 2.4e+07"));
  EXPECT_THAT(rows_of(figure.commands, "used"), ElementsAre("0.001 1.3e+07", "0.002 2.5e+07"));
  EXPECT_THAT(rows_of(figure.commands, "peak"), ElementsAre("0.0025 3e+07"));
  // Through the middle (0.15 %, 19 MPa) of the window, as far as 1.25 times its end.
  EXPECT_THAT(rows_of(figure.commands, "line"), ElementsAre("0 1e+06", "0.003 3.7e+07"));
  EXPECT_THAT(figure.commands, HasSubstr("from first 0.05,graph 0 to first 0.24,graph 1"));
  EXPECT_THAT(after(figure.commands, "using ", " "), testing::Each("($1*100):($2*1e-6)"));
}

TEST(FigureData, OfATestThatCannotBeReducedAreMillimetresAndNewtons) {
  calib::RawTest raw;
  raw.extension = {0.0, 2e-4};
  raw.force = {0.0, 90.0};
  const Figure force = test_figure({"A1.csv", raw, {}}, "t");
  EXPECT_THAT(rows_of(force.commands, "raw"), ElementsAre("0 0", "0.2 90"));
  EXPECT_THAT(force.commands, AllOf(HasSubstr("'Extension (mm)'"), HasSubstr("'Force (N)'")));
  raw.extension.clear();
  raw.force.clear();
  raw.time = {0.0, 3.0};
  raw.stress = {0.0, 40e6};
  const Figure stress = test_figure({"A1.csv", raw, {}}, "t");
  EXPECT_THAT(rows_of(stress.commands, "raw"), ElementsAre("0 0", "3 40"));
  EXPECT_THAT(stress.commands, AllOf(HasSubstr("'Time (s)'"), HasSubstr("'Stress (MPa)'")));
}

TEST(FigureData, OfClocksAreTheirFourSignals) {
  calib::ClockFit clocks;
  clocks.machine = {{1.0, 2.0}, {0.1, 0.2}};
  clocks.logger = {{3.0, 4.0}, {0.3, 0.4}};
  clocks.aligned = {{1.5, 2.5}, {0.5, 0.6}};
  clocks.residual = {{1.25, 1.75}, {0.07, -0.08}};
  const std::string commands = clocks_figure(clocks, "c").commands;
  EXPECT_THAT(rows_of(commands, "machine"), ElementsAre("1 0.1", "2 0.2"));
  EXPECT_THAT(rows_of(commands, "logger"), ElementsAre("3 0.3", "4 0.4"));
  EXPECT_THAT(rows_of(commands, "aligned"), ElementsAre("1.5 0.5", "2.5 0.6"));
  EXPECT_THAT(rows_of(commands, "residual"), ElementsAre("1.25 0.07", "1.75 -0.08"));
  EXPECT_THAT(after(commands, "using ", " "), testing::Each("1:($2*100)"));
}

TEST(FigureData, OfASectionAreSharesByDepth) {
  const std::string commands = histogram_figure({{0.0, 1.0}, {0.9, 0.1}, 0.48}, "d").commands;
  EXPECT_THAT(rows_of(commands, "depth"), ElementsAre("0 0.9", "1 0.1"));
  EXPECT_THAT(commands, HasSubstr("set arrow from 0.48,graph 0 to 0.48,graph 1"));
}

TEST(FigureData, OfWaysToMeasurePorosityAreTimesOfAMillionPixelsAndErrorsInPoints) {
  calib::PorosityTrial trial{.hardship = "noise", .pixels = 2e6, .truth = 0.05};
  trial.readings = {{{0.15, 4e-3}, {0.1, 8e-3}, {0.07, 2e-2}, {0.05, 0.0}}};
  const std::string commands = methods_figure(calib::compare_methods({trial}), "m").commands;
  EXPECT_THAT(rows_of(commands, "method0"), ElementsAre("2 10"));
  EXPECT_THAT(rows_of(commands, "method1"), ElementsAre("4 5"));
  // What a logarithmic axis cannot show lies on its edge: 0.001 points, 10 µs.
  EXPECT_THAT(rows_of(commands, "method3"), ElementsAre("0.005 0.001"));
}

TEST(FigureData, OfChainsAreTheirErrorsByWhatTheyCost) {
  calib::ChainSummary chain;
  chain.chain = "a";
  chain.by_simulations = {{50.0, {0.01, 0.02, 0.04}}};
  chain.by_seconds = {{0.7, {0.03, 0.05, 0.06}}};
  const calib::ChainBenchmark benchmark{{}, {chain}};
  const Figure simulations = chains_figure(benchmark, ChainCost::simulations, "c"),
               seconds = chains_figure(benchmark, ChainCost::seconds, "c");
  EXPECT_THAT(rows_of(simulations.commands, "chain0"), ElementsAre("50 1 2 4"));
  EXPECT_THAT(rows_of(seconds.commands, "chain0"), ElementsAre("0.7 3 5 6"));
  EXPECT_THAT(simulations.commands,
              AllOf(HasSubstr("set xlabel 'Simulations'"),
                    HasSubstr("using 1:2:4 with filledcurves"), HasSubstr("using 1:3 with lines")));
  EXPECT_THAT(seconds.commands, HasSubstr("set xlabel 'Wall time (s)'"));
}

// Five runs of 38 to 42 MPa: t(0.975; 4) = 2.7764, so that the mean is known to ± 1.963 MPa.
TEST(FigureData, OfASweepAreMeansWithTheirIntervals) {
  const test::KnownSweep known({{"joints.scatter", {"0.2"}}}, 5,
                               [](const calib::SweepPoint&, int k) { return 1e6 * (38.0 + k); });
  calib::Sweep sweep;
  sweep.plan = known.plan;
  calib::SweepResult result;
  result.points = known.points;
  result.runs = known.runs;
  result.summaries = {calib::summary_of(known.runs, 0)};
  const std::string commands =
      sweep_figures(sweep, result, {.caption = "c", .x = "joints.scatter"}, "f")
          .front()
          .figure.commands;
  const double half = 2.7764451 * std::sqrt(2.5 / 5.0);
  EXPECT_THAT(rows_of(commands, "s0"),
              ElementsAre(fmt::format("0.2 40 {:.6g} {:.6g}", 40.0 - half, 40.0 + half)));
  EXPECT_THAT(commands, AllOf(HasSubstr(":3:4 with yerrorbars"), HasSubstr("$s0 using 1:2 with")));
}

// Where the symbols of full points stand below the legend of an SVG, from its upper left corner.
// [px]
std::vector<std::array<double, 2>> full_points(const std::string& svg) {
  constexpr double legend = 60.0;
  std::vector<std::array<double, 2>> places;
  for (const std::string& place : after(svg, "#work-gpPt6' transform='translate(", ")")) {
    const double x = std::stod(place), y = std::stod(place.substr(place.find(',') + 1));
    if (y > legend) places.push_back({x, y});
  }
  return places;
}

// A decade of time is as long from 0.1 to 1 s as from 1 to 10 s, and errors fall by three decades,
// then by one.
TEST(FigureData, OfWorkAndPrecisionAreErrorsOverTimeOnLogarithmicAxes) {
  const auto all = [](double value) { return sim::BenchSpread{value, value, value, 1}; };
  sim::WorkPrecision study{.complete = true};
  study.rows.resize(4);  // the first is the reference
  const std::array<double, 4> cpu{0.1, 0.1, 1.0, 10.0}, error{0.0, 1e-2, 1e-5, 1e-6};
  for (std::size_t i = 0; i < 4; ++i) {
    sim::BenchRow& row = study.rows[i];
    row.setting.step = 1e-8 / (1.0 + static_cast<double>(i));
    row.runs = row.trusted = 1;
    row.cpu = all(cpu.at(i));
    row.errors.bonded_forces = all(test::nan);
    row.errors.failure_strain = all(error.at(i));
    // What is not drawn.
    row.wall = all(77.0);
    row.errors.strength = all(0.5);
  }
  const auto points = full_points(work_precision_svg(study));
  ASSERT_EQ(points.size(), 3U);
  EXPECT_GT(points[1][0], points[0][0] + 100.0);
  EXPECT_NEAR(points[2][0] - points[1][0], points[1][0] - points[0][0], 0.1);
  EXPECT_GT(points[2][1], points[1][1] + 50.0) << "downwards";
  EXPECT_NEAR(3.0 * (points[2][1] - points[1][1]), points[1][1] - points[0][1], 0.2);
}

}  // namespace
}  // namespace havers::reports
