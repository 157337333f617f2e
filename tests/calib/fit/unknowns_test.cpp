#include "calib/fit/unknowns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

std::vector<std::string> labels_of(const std::vector<Unknown>& unknowns) {
  std::vector<std::string> labels;
  for (const auto& unknown : unknowns) labels.push_back(unknown.label);
  return labels;
}

TEST(Unknowns, AreOnePerParameterWhenShared) {
  const auto unknowns = unknowns_of(test::synthetic_study({0.0, 45.0}));
  EXPECT_EQ(labels_of(unknowns), (std::vector<std::string>{"young_GPa", "head_tail_MPa", "ratio"}));
  EXPECT_EQ(unknowns[0].specimens.size(), 4U);
}

TEST(Unknowns, AreOnePerOrientationOrSpecimenWhereAsked) {
  auto study = test::synthetic_study({0.0, 45.0});
  study.calibrate.parameters = {"young_GPa", "ratio"};
  study.calibrate.level = {{"young_GPa", Level::orientation}, {"ratio", Level::specimen}};
  const auto unknowns = unknowns_of(study);
  EXPECT_EQ(labels_of(unknowns),
            (std::vector<std::string>{"young_GPa[0 deg]", "young_GPa[45 deg]", "ratio[S1]",
                                      "ratio[S2]", "ratio[S3]", "ratio[S4]"}));
  EXPECT_EQ(unknowns[1].specimens, (std::vector<std::size_t>{2, 3}));
}

TEST(Unknowns, StartInsideTheirBounds) {
  auto study = test::synthetic_study({0.0});
  study.model.material.young = 100e9;
  study.calibrate.bounds["young_GPa"] = {5.0, 30.0};
  const auto unknowns = unknowns_of(study);
  EXPECT_EQ(unknowns[0].start, std::log(30.0));
  EXPECT_NEAR(from_search(*unknowns[0].info, middle_point(unknowns)[0]), std::sqrt(150.0), 1e-12);
  Point point = start_point(unknowns);
  point[0] = std::nan("");
  point[1] = 1e9;
  point = inside_bounds(unknowns, point);
  EXPECT_EQ(point[0], unknowns[0].start);
  EXPECT_EQ(point[1], unknowns[1].upper);
}

// A specimen kept for validation has no unknown of its own: it takes the (geometric) mean of the
// others'.
TEST(Unknowns, GiveAHeldOutSpecimenTheMeanOfTheOthers) {
  auto study = test::synthetic_study({0.0, 45.0});
  study.calibrate.parameters = {"young_GPa"};
  study.calibrate.level["young_GPa"] = Level::specimen;
  study.specimens[3].use = Use::validate;
  const auto unknowns = unknowns_of(study);
  ASSERT_EQ(unknowns.size(), 3U);
  Point point(3);
  point << std::log(10.0), std::log(20.0), std::log(40.0);
  const auto& info = *find_parameter("young_GPa");
  EXPECT_NEAR(*value_at(unknowns, point, info, 1), 20.0, 1e-12);
  EXPECT_NEAR(*value_at(unknowns, point, info, 3), 20.0, 1e-12);
  EXPECT_FALSE(value_at(unknowns, point, *find_parameter("scatter"), 0));
}

TEST(Unknowns, GiveAHeldOutSpecimenItsGroupWhereverItIsListed) {
  auto study = test::synthetic_study({0.0, 45.0});
  study.calibrate.parameters = {"young_GPa"};
  study.calibrate.level["young_GPa"] = Level::orientation;
  study.specimens[0].use = study.specimens[3].use = Use::validate;
  const auto unknowns = unknowns_of(study);
  EXPECT_EQ(labels_of(unknowns),
            (std::vector<std::string>{"young_GPa[0 deg]", "young_GPa[45 deg]"}));
  Point point(2);
  point << std::log(10.0), std::log(20.0);
  const auto& info = *find_parameter("young_GPa");
  EXPECT_NEAR(*value_at(unknowns, point, info, 0), 10.0, 1e-12);
  EXPECT_NEAR(*value_at(unknowns, point, info, 3), 20.0, 1e-12);
}

// Their logarithms do not come back as the same numbers: exp(log 12) is more than 12.
TEST(Unknowns, EndAtTheBoundsAsTheStudyGivesThem) {
  auto study = test::synthetic_study({0.0, 90.0});
  study.calibrate.parameters = {"young_GPa"};
  study.calibrate.bounds["young_GPa"] = {0.1, 12.0};
  const auto parameter = test::parameter_of(test::fit(study), "young_GPa");
  EXPECT_EQ(parameter.bounds, (std::array{0.1, 12.0}));
  EXPECT_TRUE(parameter.at_bound);
  EXPECT_EQ(parameter.value, 12.0);
}

TEST(Unknowns, OfAutoLeaveTheScatterToWhatPorosityTells) {
  Study study;
  study.specimens.push_back({.id = "A"});
  study.calibrate.automatic = true;
  const auto tries_scatter = [&] {
    return std::ranges::any_of(unknowns_of(study),
                               [](const Unknown& unknown) { return unknown.label == "scatter"; });
  };
  EXPECT_TRUE(tries_scatter());
  study.specimens[0].porosity = 0.05;
  EXPECT_TRUE(tries_scatter()) << "windows are of sections";
  study.porosity.to_scatter = ToScatter::linear;
  EXPECT_FALSE(tries_scatter());
  study.specimens[0].sections.emplace_back();
  study.porosity.to_scatter = ToScatter::window;
  EXPECT_FALSE(tries_scatter());
  study.specimens[0].sections[0].window_sd = std::nan("");
  EXPECT_TRUE(tries_scatter()) << "sections without a pixel size have no windows";
  study.specimens[0].sections[0].window_sd = 0.1;
  study.porosity.to_scatter = ToScatter::none;
  EXPECT_TRUE(tries_scatter());
}

}  // namespace
}  // namespace havers::calib
