#include "reports/figures/figures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "reports/figures/process.hpp"
#include "reports/figures/thin.hpp"
#include "sim/simulation.hpp"
#include "tests/reports/sound_page.hpp"
#include "tests/support/results.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/slow.hpp"

namespace havers::reports {
namespace {

using test::contains;

TEST(Thin, KeepsThePeakTheEndAndTheOrder) {
  std::vector<double> x, y;
  for (int i = 0; i < 10000; ++i) {
    x.push_back(i);
    y.push_back(i == 6789 ? 5.0 : 0.001 * (i % 7));
  }
  const Points points = thin(x, y);
  EXPECT_LE(points.x.size(), 400U);
  EXPECT_GE(points.x.size(), 200U);
  EXPECT_TRUE(std::is_sorted(points.x.begin(), points.x.end()));
  EXPECT_EQ(std::count(points.x.begin(), points.x.end(), 6789.0), 1);
}

TEST(Thin, DropsWhatIsNotFinite) {
  EXPECT_EQ(
      thin(std::vector<double>{1.0, test::nan, 3.0}, std::vector<double>{1.0, 2.0, test::nan}).x,
      std::vector<double>{1.0});
}

TEST(Figure, IsAnSvgThatFillsItsContainer) {
  const auto sample = test::fit_sample();
  const std::string svg = draw(specimen_figure(sample.result.specimens.front(), "s0"));
  EXPECT_TRUE(svg.starts_with("<svg role=\"img\" width=\"100%\""));
  EXPECT_TRUE(contains(svg, "viewBox=\"0 0 640 430\""));
  EXPECT_TRUE(contains(svg, "Strain (%)"));
  EXPECT_TRUE(contains(svg, "95 % of the replicates"));
  EXPECT_TRUE(contains(svg, "id='s0-gpDot'"));
  EXPECT_FALSE(contains(svg, "id='gpDot'"));
  for (const char* own : {"<title>$", "<title>gnuplot"})
    EXPECT_FALSE(contains(svg, own)) << "gnuplot's commands where the mouse rests";
  EXPECT_TRUE(contains(svg, "<title>measured</title>"));
}

// A strength that was not reached is none.
TEST(Figure, SaysWhereATestWasStopped) {
  auto specimen = test::fit_sample().result.specimens.front();
  specimen.measured.broke = true;
  EXPECT_TRUE(contains(draw(specimen_figure(specimen, "s0")), "measured strength"));
  specimen.measured.broke = false;
  const std::string svg = draw(specimen_figure(specimen, "s0"));
  EXPECT_TRUE(contains(svg, "stopped here"));
  EXPECT_FALSE(contains(svg, "measured strength"));
}

// White inside, they would be nothing but outlines below those that were fitted.
TEST(Figure, DrawsSpecimensOfTheValidationOnTop) {
  auto sample = test::fit_sample();
  auto& specimens = sample.result.specimens;
  for (std::size_t i = 0; i < specimens.size(); ++i)
    specimens[i].use = i == 0 ? calib::Use::validate : calib::Use::fit;
  const std::string commands = strength_figure(specimens, "strength").commands;
  EXPECT_LT(commands.rfind("pt 7"), commands.find("rgb 'white'"));
  EXPECT_LT(commands.find("rgb 'white'"), commands.find(", validation"));
}

// Where points lie close to each other their names would lie on each other.
TEST(Figure, NamesTheSpecimensThatHaveRoom) {
  const auto sample = test::fit_sample();
  const std::string svg = draw(strength_figure(sample.result.specimens, "strength"));
  const auto& specimens = sample.result.specimens;
  const auto named = std::count_if(specimens.begin(), specimens.end(), [&](const auto& specimen) {
    return contains(svg, specimen.id);
  });
  EXPECT_GE(named, 2);
  EXPECT_TRUE(contains(svg, "45°"));
  EXPECT_TRUE(contains(svg, "90°, validation"));
}

TEST(Figure, KeepsNumbersBelowIntervalsApart) {
  auto sample = test::fit_sample();
  sample.result.parameters.front().interval_95 = {16.472, 16.545};
  EXPECT_TRUE(contains(intervals_figure({{sample.study, sample.result, {}, {}}}, "b").commands,
                       "set xtics 0.02\n"));
}

// Names take turns to the right and to the left of points along the line of equality.
TEST(Figure, NamesNeighboursOnEitherSide) {
  std::vector<calib::SpecimenResult> specimens;
  for (const double strength : {13.0, 13.3, 80.0, 82.0}) {
    calib::SpecimenResult& specimen = specimens.emplace_back();
    specimen.id = fmt::format("S{}", specimens.size());
    specimen.measured.strength = specimen.strength.mean = 1e6 * strength;
  }
  const std::string svg = draw(strength_figure(specimens, "strength"));
  for (const auto& specimen : specimens) EXPECT_TRUE(contains(svg, specimen.id)) << specimen.id;
}

TEST(Figure, TellsTestsThatWereStoppedFromThoseThatBroke) {
  auto sample = test::fit_sample();
  EXPECT_FALSE(contains(draw(strength_figure(sample.result.specimens, "s")), "stopped, at least"));
  sample.result.specimens.front().measured.broke = false;
  const Figure figure = strength_figure(sample.result.specimens, "s");
  EXPECT_TRUE(contains(draw(figure), "stopped, at least"));
  const std::size_t begin = figure.commands.find("$stopped << EOD\n");
  const std::string rows =
      figure.commands.substr(begin, figure.commands.find("\nEOD", begin) - begin);
  EXPECT_EQ(std::ranges::count(rows, '\n'), 1);
}

// Two names a row of 20 pixels, and two rows have room anyway.
TEST(Figure, HasRoomForTheLegendOfSixGroups) {
  auto specimens = test::fit_sample().result.specimens;
  for (std::size_t i = 0; i < specimens.size(); ++i)
    specimens[i].use = i % 2 == 0 ? calib::Use::fit : calib::Use::validate;
  specimens.front().measured.broke = false;
  EXPECT_EQ(strength_figure(specimens, "s").height, 480 + 40);
  specimens.resize(1);
  EXPECT_EQ(strength_figure(specimens, "s").height, 480);
}

// To the right of the first, "longer" would stand beside the second point.
TEST(Figure, NamesAnglesAsTheTableDoes) {
  auto specimens = test::fit_sample().result.specimens;
  specimens.front().orientation = 22.5 * std::numbers::pi / 180.0;
  EXPECT_TRUE(contains(draw(strength_figure(specimens, "strength")), ">22.5°<"));
}

// Seven chains, six of them thin: hue alone would not tell them apart.
TEST(Figure, TellsChainsApartInGrey) {
  std::vector<calib::ChainRow> rows;
  for (const calib::Chain& chain : calib::all_chains())
    rows.push_back({.chain = chain.name, .error = 0.1, .trace = {{10, 0.1, 0.4}, {20, 0.5, 0.1}}});
  const std::string commands =
      chains_figure(calib::summarise(std::move(rows)), ChainCost::simulations, "c").commands;
  const std::vector<std::string> dashes = test::after(commands, " dt ", ")");
  EXPECT_EQ(dashes.size(), 5U);
  EXPECT_EQ(std::set<std::string>(dashes.begin(), dashes.end()).size(), dashes.size());
}

TEST(Figure, NamesTheCostOfStartsAndKeepsItsLegendOutside) {
  calib::CalibrationResult result;
  result.starts = {93.0, 178.0, 12000.0};
  result.ends = {93.0, 94.0};
  const Figure figure = waterfall_figure(result, "w");
  EXPECT_FALSE(contains(figure.commands, "key inside"));
  for (const char* words : {">Cost<", ">starts<", ">refined<"})
    EXPECT_TRUE(contains(draw(figure), words)) << words;
}

TEST(Figure, GivesNoPointTheNameOfAnother) {
  std::vector<calib::SpecimenResult> specimens;
  for (const double strength : {40.0, 44.2, 60.0}) {
    calib::SpecimenResult& specimen = specimens.emplace_back();
    specimen.id = fmt::format("longer{}", specimens.size());
    specimen.measured.strength = 1e6 * strength;
    specimen.strength.mean = 0.99e6 * strength;
  }
  specimens[1].strength.mean = 38.9e6;
  const std::string commands = strength_figure(specimens, "strength").commands;
  EXPECT_FALSE(contains(commands, "\"longer1\" \"\"")) << commands;
  EXPECT_TRUE(contains(commands, "\"\" \"longer1\"")) << commands;
}

TEST(Figure, ShowsBothSidesOnlyWhereTheyDiffer) {
  const sim::Assembly assembly;
  auto simulation = test::simulation_sample(assembly);
  const SimulationReport report{{}, assembly, simulation, {}};
  EXPECT_TRUE(contains(draw(simulation_figure(report, "c")), "left side"));
  EXPECT_TRUE(contains(simulation_figure(report, "c").commands, "dt 2 lc rgb orange title 'left"));
  simulation.regime = sim::Regime::quasi_static;
  EXPECT_FALSE(contains(draw(simulation_figure(report, "c")), "left side"));
}

TEST(Figure, ShowsTheEnergyThatStepsTakeWhereItIsSome) {
  const sim::Assembly assembly;
  auto simulation = test::simulation_sample(assembly);
  const SimulationReport report{{}, assembly, simulation, {}};
  for (const double loss : {0.005, 0.02}) {
    simulation.numerical_loss = loss;
    EXPECT_EQ(contains(draw(simulation_figure(report, "c")), ">lost<"), loss > 0.01);
  }
}

// Half way to the first break a quarter of the energy is stored, steps or no steps.
TEST(Figure, DrawsTheEnergyOfStrainThatWasLeaptOver) {
  HAVERS_SLOW;
  sim::Scene scene = test::dynamic_scene(90.0);
  scene.solver.step.reset();
  const sim::Assembly assembly = sim::build_assembly(scene.assembly, scene.loading.lateral);
  const sim::Simulation simulation = sim::simulate(scene);
  ASSERT_GT(simulation.leapt_strain, 0.0);
  const auto& before_break = *std::ranges::find_if(
      simulation.curve, [&](const auto& row) { return row.strain > simulation.leapt_strain; });
  std::istringstream rows(simulation_figure({scene, assembly, simulation, {}}, "c").commands);
  std::string header;
  std::getline(rows, header);
  int between = 0;
  double strain = 0.0, right = 0.0, left = 0.0, broken = 0.0, elastic = 0.0, rest = 0.0;
  while (strain < before_break.strain * (1.0 - 1e-5) &&
         rows >> strain >> right >> left >> broken >> elastic >> rest >> rest >> rest) {
    const double part = strain / before_break.strain;
    EXPECT_NEAR(elastic / before_break.elastic, part * part, 1e-3);
    EXPECT_NEAR(right / before_break.stress_right, part, 1e-3);
    between += part > 0.1 && part < 0.9 ? 1 : 0;
  }
  EXPECT_GT(between, 20);
}

TEST(Figure, CountsBrokenJointsOfEitherKindAsTheyBreak) {
  const sim::Scene scene = test::small_scene();
  const sim::Assembly assembly = sim::build_assembly(scene.assembly, scene.loading.lateral);
  const sim::Simulation simulation = sim::simulate(scene);
  const std::string commands = simulation_figure({scene, assembly, simulation, {}}, "c").commands;
  const auto last_count = [&](const std::string& name) {
    const std::size_t begin = commands.find("$" + name + " << EOD");
    const std::size_t end = commands.find("\nEOD", begin);
    return std::stoi(commands.substr(commands.rfind(' ', end)));
  };
  std::map<sim::JointKind, int> broken;
  for (std::size_t j = 0; j < assembly.joints.size(); ++j)
    broken[assembly.joints[j].kind] += simulation.joints[j].broken ? 1 : 0;
  EXPECT_EQ(last_count("head_tail"), broken[sim::JointKind::head_tail]);
  EXPECT_EQ(last_count("flank"), broken[sim::JointKind::flank]);
  EXPECT_GT(broken[sim::JointKind::flank], 0);
}

TEST(Figure, CountsInWholeNumbersAlone) {
  const sim::Scene scene = test::small_scene();
  const sim::Assembly assembly = sim::build_assembly(scene.assembly, scene.loading.lateral);
  const auto commands = [&](std::size_t broken) {
    sim::Simulation simulation = test::simulation_sample(assembly);
    for (std::size_t j = 0; j < simulation.joints.size(); ++j)
      simulation.joints[j] = {.threshold = {1.0, 1.0}, .broken = j < broken};
    return simulation_figure({scene, assembly, simulation, {}}, "c").commands;
  };
  EXPECT_FALSE(contains(commands(assembly.joints.size()), "set ytics 1\n"));
  EXPECT_TRUE(contains(commands(1), "set yrange [0:*]\nset ytics 1\n"));
  EXPECT_TRUE(contains(commands(0), "set yrange [0:1]\nset ytics 1\n"));
}

TEST(Figure, LetsNoNameReachTheCommandsOfGnuplot) {
  auto sample = test::fit_sample();
  sample.study.name = "'; system('false'); \n exit status 3 `false`";
  sample.result.specimens.front().id = "\"\nEOD\nexit status 3\n";
  for (const Figure& figure : {strength_figure(sample.result.specimens, "a"),
                               intervals_figure({{sample.study, sample.result, {}, {}}}, "b")})
    EXPECT_FALSE(contains(draw(figure), "Figure not drawn"));
}

TEST(Figure, ShowsThePercentSignsOfAName) {
  auto sample = test::fit_sample();
  sample.study.name = "bone, 5 % of E";
  EXPECT_TRUE(contains(draw(intervals_figure({{sample.study, sample.result, {}, {}}}, "b")),
                       "bone, 5 % of E"));
}

TEST(Figure, SaysSoWhenThereIsNothingToDraw) {
  EXPECT_TRUE(contains(draw(specimen_figure({}, "s")), "Nothing to draw"));
  EXPECT_TRUE(contains(draw(strength_figure({}, "s")), "Nothing to draw"));
  EXPECT_TRUE(contains(draw(simulation_figure({{}, {}, {}, {}}, "s")), "Nothing to draw"));
  EXPECT_TRUE(contains(draw(intervals_figure({}, "s")), "Nothing to draw"));
}

TEST(Figure, SaysWhatGnuplotComplainedAbout) {
  const std::string svg = draw({.id = "x", .description = "", .commands = "plot <nonsense>\n"});
  EXPECT_TRUE(contains(svg, "Figure not drawn; gnuplot says"));
}

TEST(Figure, IsASentenceWithoutGnuplot) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const std::string svg = draw({.id = "x", .description = "", .commands = "plot x\n"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(contains(svg, "gnuplot did not start (apt-get install gnuplot-nox)"));
}

// A wrapper, or another version, that answers otherwise.
TEST(Figure, IsASentenceWhereGnuplotGivesNoFigure) {
  const test::ScratchFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", fmt::format("{}:{}", folder.path().string(), path).c_str(), 1);
  for (const char* said : {"", "</svg>", "<svg></svg>", "</desc><svg><title></svg>"}) {
    const auto fake = folder.write("gnuplot", fmt::format("#!/bin/sh\necho '{}'\n", said));
    std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
    const std::string svg = draw({.id = "x", .description = "", .commands = "plot x\n"});
    EXPECT_TRUE(contains(svg, "Figure not drawn: gnuplot was ended, or gave no figure.")) << said;
  }
  setenv("PATH", path.c_str(), 1);
}

TEST(Process, IsInAGroupOfItsOwn) {
  const ProcessResult group = run_process({"sh", "-c", "cut -d ' ' -f 5 /proc/$$/stat"}, "");
  EXPECT_NE(std::stol(group.output), getpgrp());
}

TEST(Process, DoesNotStartWithoutAPlaceForItsFiles) {
  const char* before = std::getenv("TMPDIR");
  const std::string place = before == nullptr ? "" : before;
  setenv("TMPDIR", "/nonexistent", 1);
  ProcessResult result;
  EXPECT_NO_THROW(result = run_process({"cat"}, ""));
  EXPECT_FALSE(result.started);
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", place.c_str(), 1);
}

TEST(Process, HandsOverItsInputAndEndsWithItsStatus) {
  const ProcessResult copied = run_process({"cat"}, "as it is");
  EXPECT_EQ(copied.status, 0);
  EXPECT_EQ(copied.output, "as it is");
  EXPECT_EQ(run_process({"false"}, "").status, 1);
  EXPECT_FALSE(run_process({"no-such-program-anywhere"}, "").started);
}

TEST(IntervalBar, StaysBetweenItsBounds) {
  calib::CalibratedParameter parameter;
  parameter.value = 20.0;
  parameter.interval_95 = {-100.0, 500.0};
  parameter.bounds = {0.0, 40.0};
  const std::string bar = interval_bar(parameter);
  EXPECT_TRUE(contains(bar, "<rect x=\"4.0\" y=\"5\" width=\"192.0\""));
  EXPECT_TRUE(contains(bar, "M100.0 2V14"));
  parameter.value = test::nan;
  EXPECT_EQ(interval_bar(parameter), "");
}

}  // namespace
}  // namespace havers::reports
