// import, and what it says of good and bad test files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;

// A study whose two tests are made by the program.
fs::path folder_with_tests() {
  const fs::path folder = own_folder();
  test::write_text(folder / "study.toml", test::small_study());
  EXPECT_EQ(run_havers(folder, "synthesize study.toml -o made").exit_code, 0);
  return folder;
}

TEST(Import, GivesBackWhatSynthesizePutIn) {
  const fs::path folder = folder_with_tests();
  const auto truth = nlohmann::json::parse(test::read_text(folder / "made/truth.json"));
  const auto answer = run_havers(folder, "import made/B0.csv made/B90.csv --json");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const auto files = nlohmann::json::parse(answer.out).at("files");
  ASSERT_EQ(files.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& specimen = truth["specimens"][i];
    EXPECT_NEAR(files[i]["modulus_Pa"].get<double>() / specimen["modulus_Pa"].get<double>(), 1.0,
                0.01);
    EXPECT_NEAR(files[i]["strength_Pa"].get<double>() / specimen["strength_Pa"].get<double>(), 1.0,
                0.01);
    EXPECT_NEAR(files[i]["failure_strain"].get<double>() / specimen["failure_strain"].get<double>(),
                1.0, 0.02);
    EXPECT_EQ(files[i]["specimen_id"], specimen["id"]);
    EXPECT_NEAR(files[i]["area_m2"].get<double>(), 8e-6, 1e-12);
  }
}

TEST(Import, ShowsTheReadableFilesAndNamesTheOthers) {
  const fs::path folder = folder_with_tests();
  test::write_text(folder / "empty.csv", "");
  const auto answer = run_havers(folder, "import made/B0.csv empty.csv");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.out.find("B0.csv"), std::string::npos);
  EXPECT_NE(answer.err.find("empty.csv"), std::string::npos);
}

TEST(Import, TakesSizesFromTheCommandLine) {
  const fs::path folder = folder_with_tests();
  const auto answer = run_havers(folder, "import made/B0.csv --width-mm 8 --json");
  EXPECT_NEAR(nlohmann::json::parse(answer.out)["area_m2"].get<double>(), 16e-6, 1e-12)
      << answer.err;
}

}  // namespace
}  // namespace havers
