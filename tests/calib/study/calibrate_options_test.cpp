#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/study/parameter.hpp"
#include "calib/study/study.hpp"

namespace havers::calib {
namespace {

TEST(CalibrateOptions, AreUsableByDefault) {
  EXPECT_TRUE(CalibrateOptions{}.problems().empty());
}

TEST(CalibrateOptions, NameEveryProblemAtOnce) {
  CalibrateOptions options;
  options.parameters = {"young_GPa", "young_GPa", "yung_GPa"};
  options.bounds["ratio"] = {2.0, 1.0};
  options.bounds["head_tail_MPa"] = {0.0, 10.0};
  options.bounds["scatter"] = {0.0, 2.5};
  options.bounds["strength"] = {0.0, 1.0};
  options.level["flank"] = Level::specimen;
  options.replicates = 1;
  options.budget = 0;
  options.threads = -1;
  const std::vector<std::string> words{"parameters names \"young_GPa\" twice",
                                       "parameters names \"yung_GPa\"",
                                       "bounds.ratio is [2, 1]",
                                       "bounds.head_tail_MPa starts at 0",
                                       "bounds.scatter is [0, 2.5]",
                                       "bounds names \"strength\"",
                                       "level names \"flank\"",
                                       "options.replicates is 1",
                                       "options.budget is 0",
                                       "threads is -1"};
  const auto problems = options.problems();
  EXPECT_EQ(problems.size(), words.size());
  for (const auto& word : words)
    EXPECT_TRUE(std::ranges::any_of(problems, [&](const CalibrateOptions::Problem& problem) {
      return (problem.key + " " + problem.what).find(word) != std::string::npos;
    })) << word;
}

TEST(CalibrateOptions, RefuseParametersOfWhichOneUndoesTheOther) {
  const auto table = all_parameters();
  CalibrateOptions options;
  for (const auto& one : table)
    for (const auto& other : table) {
      if (one.of_porosity || other.of_porosity || one.name == other.name) continue;
      sim::Scene scene;
      const double first = 1.1 * value_of(scene, one.name);
      const double second = 1.3 * value_of(scene, other.name);
      // As a fit sets them: in the order of the table.
      for (const auto& info : table) {
        if (info.name == one.name) apply(scene, info.name, first);
        if (info.name == other.name) apply(scene, info.name, second);
      }
      const bool both = std::abs(value_of(scene, one.name) - first) <= 1e-9 * first &&
                        std::abs(value_of(scene, other.name) - second) <= 1e-9 * second;
      options.parameters = {std::string(one.name), std::string(other.name)};
      EXPECT_EQ(options.problems().empty(), both) << one.name << " and " << other.name;
    }
}

TEST(CalibrateOptions, NeedAParameterUnlessTheyAreAutomatic) {
  CalibrateOptions options;
  options.parameters.clear();
  EXPECT_EQ(options.problems().size(), 1U);
  options.automatic = true;
  EXPECT_TRUE(options.problems().empty());
}

}  // namespace
}  // namespace havers::calib
