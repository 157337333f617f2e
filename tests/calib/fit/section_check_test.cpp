// What sections leave in doubt, or do not tell, is in the verdict.
#include "calib/fit/section_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::check_of;
using test::says;

Study porous_study() {
  Study study = test::synthetic_study(test::three_orientations);
  for (Specimen& specimen : study.specimens) specimen.porosity = 0.05;
  return study;
}

TEST(Verdict, WarnsOfSectionsWhosePorosityIsInDoubt) {
  Study study = porous_study();
  const auto check = [&] { return check_sections(make_problem(study)); };
  study.porosity.to_scatter = ToScatter::window;
  EXPECT_FALSE(check().done);
  EXPECT_TRUE(says(check(), "no specimen has sections")) << check().text;
  for (Specimen& specimen : study.specimens)
    for (const char* file : {"bars/one.png", "bars/two.png"})
      specimen.sections.push_back({.file = file, .porosity = *specimen.porosity});
  EXPECT_TRUE(check().done);
  EXPECT_EQ(check().outcome, Outcome::pass) << check().text;

  study.specimens[1].sections[1].doubtful = true;
  study.specimens[2].sections[0].doubtful = study.specimens[2].sections[1].doubtful = true;
  study.specimens[2].use = Use::validate;  // its prediction has them too
  EXPECT_EQ(check().outcome, Outcome::warn);
  EXPECT_TRUE(says(check(), "as their warnings say: of S2 (two.png), S3 (one.png, two.png). What"))
      << check().text;
  EXPECT_EQ(check_of(test::fit(study), "sections tell porosity").text, check().text);
  study.porosity.to_scatter = ToScatter::none;
  EXPECT_FALSE(check().done);
  study.porosity.to_modulus = ToModulus::power;
  EXPECT_EQ(check().outcome, Outcome::warn);
}

// Canals in bone are 10 to 500 µm wide; the scatter by windows goes with the pixels' size.
TEST(Verdict, WarnsOfPoresThatNoCanalHas) {
  Study study = porous_study();
  const auto check = [&] { return check_sections(make_problem(study)); };
  study.porosity.to_scatter = ToScatter::window;
  for (const double wide : {60e-6, 6e-6, 600e-6}) {
    for (Specimen& specimen : study.specimens)
      specimen.sections = {{.file = "one.png",
                            .porosity = *specimen.porosity,
                            .pore_area_ratio = 0.25 * std::numbers::pi * wide * wide}};
    EXPECT_EQ(check().outcome, wide == 60e-6 ? Outcome::pass : Outcome::warn) << check().text;
    EXPECT_EQ(says(check(), "in sections of S1 (one.png), S2 (one.png)"), wide != 60e-6);
  }
  study.porosity.to_scatter = ToScatter::linear;  // by the porosity alone
  EXPECT_EQ(check().outcome, Outcome::pass) << check().text;
}

// Beside others they have the scatter of the study's model, and the modulus of bone without pores.
TEST(Verdict, NamesSpecimensThatTellNoPorosity) {
  Study study = porous_study();
  const auto check = [&] { return check_sections(make_problem(study)); };
  study.porosity.to_scatter = ToScatter::linear;
  EXPECT_EQ(check().outcome, Outcome::pass) << check().text;
  EXPECT_TRUE(check().done);
  study.specimens[4].porosity.reset();
  EXPECT_EQ(check().outcome, Outcome::warn);
  EXPECT_EQ(check().text,
            "Nothing tells the scatter of S5: it is taken to be 0.3 (model.joints.scatter), "
            "without an error.");
  study.porosity.to_modulus = ToModulus::power;
  EXPECT_TRUE(says(check(),
                   "No porosity is known of S5: the modulus is taken for that of bone "
                   "without pores."))
      << check().text;
  study.porosity.to_scatter = ToScatter::window;  // a bare porosity tells no scatter
  study.porosity.to_modulus = ToModulus::none;
  EXPECT_FALSE(check().done);
  study.specimens[0].sections.push_back({.porosity = 0.05, .window_sd = NAN});
  EXPECT_TRUE(says(check(), "Nothing tells the scatter of S1, S2, S3, S4, S5, S6")) << check().text;
}

}  // namespace
}  // namespace havers::calib
