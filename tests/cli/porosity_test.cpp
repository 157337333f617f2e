// havers porosity, and that a study measures its sections in the same way.
#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/cli/printed.hpp"
#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

constexpr std::uint32_t side = 240;  // a multiple of 4, as the rows of a BMP are

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

// A square image of 8 bit grey levels.
void write_bmp(const fs::path& file, const std::function<int(int, int)>& grey) {
  constexpr std::uint32_t header = 14 + 40, palette = 4 * 256, pixels = side * side;
  std::string bytes = "BM";
  append(bytes, header + palette + pixels, 4);
  append(bytes, 0, 4);
  append(bytes, header + palette, 4);
  for (const std::uint32_t value : {40U, side, side}) append(bytes, value, 4);
  append(bytes, 1, 2);  // plane
  append(bytes, 8, 2);  // bits
  for (const std::uint32_t value : {0U, pixels, 2835U, 2835U, 256U, 256U}) append(bytes, value, 4);
  for (std::uint32_t level = 0; level < 256; ++level) append(bytes, 0x10101 * level, 4);
  constexpr int size = side;
  for (int y = size - 1; y >= 0; --y)
    for (int x = 0; x < size; ++x) append(bytes, static_cast<std::uint32_t>(grey(x, y)), 1);
  test::write_text(file, bytes);
}

// Bone of grey level 180 in a background of 10, round pores in rows, and right above a material of
// grey level 120.
int bone_with_pores(int x, int y) {
  if (x >= 200 && y < 10) return 120;
  if (x < 30 || x >= 210 || y < 30 || y >= 210) return 10;
  const int u = (x - 30) % 20 - 10, v = (y - 30) % 20 - 10;
  return u * u + v * v <= (x < 120 ? 9 : 25) ? 20 : 180;
}

// What lies left of a slanting line, about half of the bone.
bool in_the_mask(int x, int y) {
  return x >= 30 && x < 60 + y / 2 && y >= 30 && y < 210;
}

double area_of_the_mask(double pixel_area) {
  double area = 0.0;
  constexpr int size = side;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) area += in_the_mask(x, y) ? pixel_area : 0.0;
  return area;
}

TEST(Porosity, IsMeasuredByAStudyAsByItsOwnCommand) {
  HAVERS_SLOW;
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = test::folder_with_tests();
  write_bmp(folder / "made/s.bmp", bone_with_pores);
  write_bmp(folder / "made/m.bmp", [](int x, int y) { return in_the_mask(x, y) ? 255 : 0; });
  const auto alone = run_havers(folder,
                                "porosity made/s.bmp --pixel-size-um 5 --mask made/m.bmp --rim-um "
                                "15 --fibre-length-um 50 --fibre-height-um 8 --json");
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const auto section = nlohmann::json::parse(alone.out)["sections"][0];
  // Each option was of use.
  EXPECT_NEAR(section["window_area_um2"].get<double>(), 50.0 * 8.0, 1e-9);
  EXPECT_LT(section["bone_area_um2"], 0.97 * area_of_the_mask(25.0));
  EXPECT_GT(section["bone_area_um2"], 0.9 * area_of_the_mask(25.0));

  test::write_text(folder / "made/study.toml", test::small_study() +
                                                   "sections = [\"s.bmp\"]\nmask = \"m.bmp\"\n" +
                                                   "pixel_size_um = 5\n[sections]\nrim_um = 15\n");
  const auto fitted =
      run_havers(folder,
                 "fit made/study.toml -o out --json --set model.assembly.fibre_length_um=50 --set "
                 "model.assembly.fibre_height_um=8 --set calibrate.options.profiles=false");
  ASSERT_NE(fitted.exit_code, 2) << fitted.err;
  const auto in_the_study =
      nlohmann::json::parse(fitted.out)["study"]["specimens"][1]["sections"][0];
  EXPECT_GT(in_the_study.size(), 25U);
  for (const auto& [key, value] : in_the_study.items())
    EXPECT_EQ(value, key == "file" ? value : section.at(key)) << key;  // to the last bit
}

// The mask ends within the bone on its right.
TEST(Porosity, LeavesTheRimOutBelowAllSidesOfAMask) {
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = own_folder();
  write_bmp(folder / "s.bmp", bone_with_pores);
  write_bmp(folder / "m.bmp",
            [](int x, int y) { return x >= 30 && x < 120 && y >= 30 && y < 210 ? 255 : 0; });
  const auto answer =
      run_havers(folder, "porosity s.bmp --pixel-size-um 5 --mask m.bmp --rim-um 30 --json");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const auto section = nlohmann::json::parse(answer.out)["sections"][0];
  EXPECT_NEAR(section["bone_area_um2"].get<double>(), 25.0 * (90 - 12) * (180 - 12), 1e-6);
}

// A line through 0 at grey level 10 and 1100 at the material's 120 has 1700 at the bone's 180.
TEST(Porosity, TellsDensityByAGreyLevelAndARectangle) {
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = own_folder();
  write_bmp(folder / "s.bmp", bone_with_pores);
  const auto answer = run_havers(
      folder, "porosity s.bmp --pixel-size-um 5 --density 10=0 --density 200,0,40,10=1100 -o out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const auto json = nlohmann::json::parse(test::contents(folder / "out/porosity.json"));
  EXPECT_NEAR(json["density_kg_per_m3"].get<double>(), 1700.0, 1e-6);
  EXPECT_TRUE(json["density_residual_kg_per_m3"].is_null());
  EXPECT_THAT(answer.out, HasSubstr("  density of solid bone 1700 kg/m³, two references: no"));
}

TEST(Porosity, PrintsWhatItsJsonHas) {
  HAVERS_SLOW;
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = own_folder();
  const std::string sections = HAVERS_SOURCE_DIR "/data_samples/bone_bars/";
  const auto answer = run_havers(folder, "porosity '" + sections + "A1_section.png' '" + sections +
                                             "B1_section.png' --pixel-size-um 2 -o out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const auto json = nlohmann::json::parse(test::contents(folder / "out/porosity.json"));
  EXPECT_THAT(answer.out, testing::StartsWith("porosity [%]   +-    pores   window SD [%]   "
                                              "scatter  section\n"));
  const auto percent = [](const nlohmann::json& of, const char* key) {
    return 100.0 * of[key].get<double>();
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& one = json["sections"][i];
    test::expect_numbers(test::line_with(answer.out, one["file"].get<std::string>()),
                         {percent(one, "porosity"), percent(one, "porosity_standard_error"),
                          one["pore_count"], percent(one, "window_sd"), one["scatter"]});
  }
  const auto& mean = json["mean"];
  test::expect_numbers(test::line_with(answer.out, "all, by area"),
                       {percent(mean, "porosity"), percent(mean, "porosity_standard_error"),
                        percent(mean, "window_sd"), mean["scatter"]});
}

TEST(Porosity, ShowsTheReadableImagesAndNamesTheOthers) {
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = own_folder();
  const std::string both = "porosity none.png " HAVERS_SOURCE_DIR
                           "/data_samples/bone_bars/A1_section.png --pixel-size-um 2";
  const auto answer = run_havers(folder, both);
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.out, HasSubstr("A1_section.png"));
  EXPECT_THAT(answer.err, testing::StartsWith("havers: none.png: there is no such file"));
  const auto json = nlohmann::json::parse(run_havers(folder, both + " --json -o out").out);
  EXPECT_FALSE(json.contains("porosity"));
  ASSERT_EQ(json["sections"].size(), 2U);
  EXPECT_THAT(json["sections"][0]["error"].get<std::string>(), HasSubstr("no such file"));
  EXPECT_EQ(json["sections"][1]["porosity"], json["mean"]["porosity"]);
  EXPECT_EQ(nlohmann::json::parse(test::contents(folder / "out/porosity.json")), json);
  const auto none = nlohmann::json::parse(run_havers(folder, "porosity none.png --json").out);
  EXPECT_EQ(none["error"], json["sections"][0]["error"]);
}

TEST(Porosity, HasADashForWhatIsNotKnown) {
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const auto answer = run_havers(
      own_folder(), "porosity " HAVERS_SOURCE_DIR "/data_samples/bone_bars/A1_section.png");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, testing::Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace havers
