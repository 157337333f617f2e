#include <gtest/gtest.h>

#include <algorithm>

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
                                       "bounds of ratio are [2, 1]",
                                       "lower bound of head_tail_MPa is 0",
                                       "bounds of scatter are [0, 2.5]",
                                       "bounds names \"strength\"",
                                       "level names \"flank\"",
                                       "replicates = 1",
                                       "budget = 0",
                                       "threads = -1"};
  const auto problems = options.problems();
  EXPECT_EQ(problems.size(), words.size());
  for (const auto& word : words)
    EXPECT_TRUE(std::ranges::any_of(problems, [&](const std::string& text) {
      return text.find(word) != std::string::npos;
    })) << word;
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
