// The drawn sections of sample studies: what they say of themselves is what is measured on them.
#include <gmock/gmock.h>

#include "io/images/measure_section.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

std::filesystem::path file_of(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / "havers_drawn";
  std::filesystem::create_directories(folder);
  return folder / name;
}

TEST(DrawnSection, IsMeasuredAsItWasDrawn) {
  for (const bool ring : {false, true})
    for (const double porosity : {0.0, 0.03, 0.08, 0.15}) {
      const auto file = file_of("drawn.png");
      const auto truth = draw_section(file, {.porosity = porosity, .ring = ring}, {});
      const auto measured = measure_sections(file, {.pixel_size = 2e-6}).front().porosity;
      SCOPED_TRACE(testing::Message() << "porosity " << porosity << (ring ? ", ring" : ", bar"));
      EXPECT_NEAR(truth.porosity, porosity, 0.004);
      EXPECT_NEAR(measured.porosity, truth.porosity, 0.002);
      EXPECT_EQ(measured.pore_count, truth.pore_count);
      EXPECT_NEAR(measured.bone_area, truth.bone_area, 0.01 * truth.bone_area);
      EXPECT_NEAR(measured.window_sd, truth.window_sd, 0.05 * truth.window_sd);
    }
}

TEST(DrawnSection, IsTheSameForTheSameSeed) {
  const auto first = file_of("first.png"), second = file_of("second.png"),
             other = file_of("other.png");
  draw_section(first, {.seed = 4}, {});
  draw_section(second, {.seed = 4}, {});
  draw_section(other, {.seed = 5}, {});
  EXPECT_EQ(test::contents(first), test::contents(second));
  EXPECT_NE(test::contents(first), test::contents(other));
}

// Twelve of them go into a sample study of a few megabytes.
TEST(DrawnSection, IsASmallFile) {
  const auto file = file_of("small.png");
  draw_section(file, {.pixels = 512}, {});
  EXPECT_LT(std::filesystem::file_size(file), 150000U);
}

TEST(DrawnSection, ThatCannotBeWrittenIsNamed) {
  EXPECT_THAT(test::refusal_of([] { draw_section("no/such/folder/section.png", {}, {}); }),
              testing::HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace havers::io
