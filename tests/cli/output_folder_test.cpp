// Nothing is overwritten unasked, nothing is left half-written.
#include <gtest/gtest.h>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;

fs::path folder_with_scene() {
  const fs::path folder = own_folder();
  test::write_text(folder / "scene.toml", test::small_scene());
  return folder;
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFolder, IsNotReplacedUnlessForceIsGiven) {
  const fs::path folder = folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  const std::string first = test::read_text(folder / "out/curve.csv");
  test::write_text(folder / "out/notes.txt", "mine");

  const auto refused = run_havers(folder, "simulate scene.toml -o out --seed 5");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
  EXPECT_EQ(test::read_text(folder / "out/curve.csv"), first);

  fs::create_directories(folder / "out/snapshots");
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out --seed 5 --force").exit_code, 0);
  EXPECT_NE(test::read_text(folder / "out/curve.csv"), first);
  EXPECT_FALSE(fs::exists(folder / "out/snapshots"))
      << "an earlier run's snapshots beside a later run";
  EXPECT_EQ(test::read_text(folder / "out/notes.txt"), "mine");
}

TEST(OutputFolder, MayExistWhenEmptyAndMayBeDeep) {
  const fs::path folder = folder_with_scene();
  fs::create_directories(folder / "empty");
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o empty/").exit_code, 0);
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o a/b/c").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "empty/result.json"));
  EXPECT_TRUE(fs::exists(folder / "a/b/c/result.json"));
  EXPECT_EQ(entries(folder / "a/b"), 1U) << "the staging folder is gone";
}

TEST(OutputFolder, IsNotMadeForABadInput) {
  const fs::path folder = own_folder();
  test::write_text(folder / "bad.toml", "[assembly]\nlayers = -1\n");
  EXPECT_EQ(run_havers(folder, "simulate bad.toml -o out").exit_code, 2);
  EXPECT_EQ(entries(folder), 1U);
}

TEST(OutputFolder, CannotBeAFile) {
  const fs::path folder = folder_with_scene();
  const auto answer = run_havers(folder, "simulate scene.toml -o scene.toml --force");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(test::read_text(folder / "scene.toml"), test::small_scene());
}

}  // namespace
}  // namespace havers
