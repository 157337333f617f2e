// Fits side by side: in what they differ.
#include <gtest/gtest.h>

#include "reports/pages.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::contains;
using test::expect_sound;

TEST(ComparisonPage, TellsMissingFilesFromChangedOnes) {
  const auto fit = test::fit_sample();
  const calib::Provenance first{.inputs = {{"a.csv", "1"}, {"b.csv", "2"}}};
  const calib::Provenance second{.inputs = {{"a.csv", "3"}, {"c.csv", "4"}}};
  const std::string page =
      comparison_page({{fit.study, fit.result, {}, first}, {fit.study, fit.result, {}, second}});
  EXPECT_TRUE(contains(page, "<td>contents of a.csv; without b.csv; with c.csv</td>"));
}

// The axis of 1 to 812 began at -200.
TEST(ComparisonPage, HasNoNegativeSizesBelowIntervals) {
  auto fit = test::fit_sample();
  for (auto& parameter : fit.result.parameters) parameter.interval_95 = {1.0, 812.0};
  const std::string page =
      comparison_page({{fit.study, fit.result, {}, {}}, {fit.study, fit.result, {}, {}}});
  EXPECT_TRUE(contains(page, "800</tspan>"));
  EXPECT_FALSE(contains(page, "−200</tspan>"));
}

// Two folders may each hold a d.csv.
TEST(ComparisonPage, TellsFilesOfOneNameApart) {
  const auto fit = test::fit_sample();
  const calib::Provenance first{.inputs = {{"x/d.csv", "1"}, {"y/d.csv", "2"}}};
  const calib::Provenance second{.inputs = {{"x/d.csv", "3"}, {"y/d.csv", "2"}}};
  const calib::Provenance moved{.inputs = {{"u/d.csv", "2"}, {"v/d.csv", "1"}}};
  const auto beside_first = [&](const calib::Provenance& other) {
    return comparison_page(
        {{fit.study, fit.result, {}, first}, {fit.study, fit.result, {}, other}});
  };
  EXPECT_TRUE(contains(beside_first(second), "<td>contents of d.csv</td>"));
  EXPECT_TRUE(contains(beside_first(moved), "<td>nothing</td>"));
}

TEST(ComparisonPage, SaysInWhatFitsDiffer) {
  const auto one = test::fit_sample();
  auto two = test::fit_sample();
  two.result.parameters.pop_back();
  const calib::Provenance first{.command = "havers fit a -o b", .inputs = {{"in/a.csv", "12"}}};
  const calib::Provenance second{
      .command = "havers fit a -o c --set=model.x=1 --set 'study.name=it'\\''s one' --seed 2",
      .inputs = {{"elsewhere/a.csv", "34"}}};
  const std::string page =
      comparison_page({{one.study, one.result, {}, first}, {two.study, two.result, {}, second}});
  expect_sound(page);
  EXPECT_TRUE(contains(page,
                       "parameters: E, σ₁; settings: --set model.x=1, --set study.name=it&#39;s "
                       "one, --seed 2; contents of a.csv<"));
}

}  // namespace
}  // namespace havers::reports
