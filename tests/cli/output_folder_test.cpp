// Nothing is overwritten unasked, nothing is left half-written.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFolder, IsNotReplacedUnlessForceIsGiven) {
  const fs::path folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  fs::create_directories(folder / "out/snapshots");  // as a run with VTK leaves and notes them
  test::write_text(folder / "out/.havers",
                   test::contents(folder / "out/.havers") + "snapshots\n\n");
  const std::string first = test::contents(folder / "out/curve.csv");
  test::write_text(folder / "out/notes.txt", "mine");

  const auto refused = run_havers(folder, "simulate scene.toml -o out --seed 5");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force to replace the run in it"));
  EXPECT_EQ(test::contents(folder / "out/curve.csv"), first);

  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out --seed 5 --force").exit_code, 0);
  EXPECT_NE(test::contents(folder / "out/curve.csv"), first);
  EXPECT_FALSE(fs::exists(folder / "out/snapshots"))
      << "an earlier run's snapshots beside a later run";
  EXPECT_EQ(test::contents(folder / "out/notes.txt"), "mine");
}

TEST(OutputFolder, IsOfOneRunAtATime) {
  const fs::path folder = test::folder_with_scene();
  fs::create_directories(folder / ".out.partial");
  const int held = open((folder / ".out.partial").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(held, LOCK_EX), 0);
  const auto refused = run_havers(folder, "simulate scene.toml -o out");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("another run is writing there"));
  close(held);
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
}

// As a shell takes it again.
TEST(OutputFolder, KeepsTheCommandWithItsQuotes) {
  const fs::path folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o \"it's out\"").exit_code, 0);
  EXPECT_NE(test::contents(folder / "it's out/result.json")
                .find(R"("command": "havers simulate scene.toml -o 'it'\\''s out'")"),
            std::string::npos);
}

// A kill between two files, for which a name stands that cannot be removed.
TEST(OutputFolder, LosesTheResultBeforeItsFiles) {
  const fs::path folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  const std::string behind_curve = "d" + std::string(300, 'x') + "\n";
  test::write_text(folder / "out/.havers", test::contents(folder / "out/.havers") + behind_curve);
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out --force").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "out/curve.csv"));
  EXPECT_FALSE(fs::exists(folder / "out/result.json")) << "a result without its files";
}

// What is read or measured first would be lost.
TEST(OutputFolder, IsRefusedBeforeAnythingIsDone) {
  const fs::path folder = test::folder_with_tests();
  fs::create_directories(folder / "full/of");
  for (const char* command : {"import made/B0.csv", "porosity none.png"}) {
    const auto answer = run_havers(folder, command + std::string(" -o full"));
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_EQ(answer.out, "") << command;
    EXPECT_THAT(answer.err, HasSubstr("is not empty (no run has written there; "));
  }
  EXPECT_EQ(run_havers(folder, "import none.csv -o far/away/from/here").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "far"));
}

// Neither what lies beside them in their folder, nor what has taken a name that they once had.
TEST(OutputFolder, LosesTheFilesOfItsRunsAlone) {
  const fs::path folder = test::folder_with_scene();
  test::write_text(folder / "study.toml",
                   test::replaced_once(test::small_study(), "B0.csv", "tests/B0.csv"));
  ASSERT_EQ(run_havers(folder, "synthesize study.toml -o out").exit_code, 0);
  test::write_text(folder / "out/tests/mine.csv", "mine");
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out --force").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/study.toml"));
  EXPECT_FALSE(fs::exists(folder / "out/tests/B0.csv"));
  EXPECT_EQ(test::contents(folder / "out/tests/mine.csv"), "mine");

  test::write_text(folder / "out/tests/B0.csv", "mine");
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out --force").exit_code, 0);
  EXPECT_EQ(test::contents(folder / "out/tests/B0.csv"), "mine");
}

// Nor through a link in their folder's place, or by a name that leads out of it.
TEST(OutputFolder, LosesNothingElsewhere) {
  const fs::path folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  fs::create_directories(folder / "own");
  test::write_text(folder / "own/B0.csv", "mine");
  fs::create_directory_symlink("../own", folder / "out/tests");
  test::write_text(folder / "out/.havers", test::contents(folder / "out/.havers") +
                                               "tests/B0.csv\n../own/B0.csv\n" +
                                               (folder / "own/B0.csv").string() + "\n");
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out --force").exit_code, 0);
  EXPECT_EQ(test::contents(folder / "own/B0.csv"), "mine");
}

// As earlier builds have listed folders: whose the files in one are is not known.
TEST(OutputFolder, KeepsAFolderThatIsListed) {
  const fs::path folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  fs::create_directories(folder / "out/curves");
  test::write_text(folder / "out/curves/mine.csv", "mine");
  test::write_text(folder / "out/.havers", test::contents(folder / "out/.havers") + "curves\n");
  const auto refused = run_havers(folder, "simulate scene.toml -o out --force");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("curves: is a folder that may hold files of your own"));
  EXPECT_EQ(test::contents(folder / "out/curves/mine.csv"), "mine");
  EXPECT_TRUE(fs::exists(folder / "out/result.json"));
}

// The tests that were made, and the study itself.
TEST(OutputFolder, IsRefusedWhereAnInputWouldGo) {
  const fs::path folder = test::folder_with_tests();
  const std::size_t before = entries(folder / "made");
  fs::create_symlink("made/B0.csv", folder / "link.csv");
  for (const char* command : {"fit made/study.toml", "import link.csv"}) {
    const auto refused = run_havers(folder, command + std::string(" -o made --force"));
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("B0.csv: is read by this run")) << command;
    EXPECT_EQ(entries(folder / "made"), before);
  }
}

// Not even by --force: neither a scene and curves of the user's own, nor his result.
TEST(OutputFolder, KeepsWhatNoRunHasWritten) {
  const fs::path folder = test::folder_with_scene();
  fs::create_directories(folder / "curves");
  test::write_text(folder / "curves/mine.csv", "mine");
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o . --force").exit_code, 0);
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o . --force").exit_code, 0);
  EXPECT_EQ(test::contents(folder / "scene.toml"), test::small_scene());
  EXPECT_EQ(test::contents(folder / "curves/mine.csv"), "mine");

  fs::create_directories(folder / "other");
  test::write_text(folder / "other/result.json", "mine");
  const auto refused = run_havers(folder, "simulate scene.toml -o other --force");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("result.json"));
  EXPECT_EQ(entries(folder / "other"), 1U);
  EXPECT_EQ(test::contents(folder / "other/result.json"), "mine");
}

// Which files a run leaves is known at its end alone.
TEST(OutputFolder, SetsResultsApartFromAFileInTheirWay) {
  const fs::path folder = test::folder_with_scene();
  fs::create_directories(folder / "out");
  test::write_text(folder / "out/curve.csv", "mine");
  for (const std::string apart : {"out/results", "out/results_2"}) {
    const auto refused = run_havers(folder, "simulate scene.toml -o out --force");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("curve.csv: was not written by a run of havers and stays "));
    EXPECT_THAT(refused.err, HasSubstr("results are in " + (folder / apart).string() + ")"));
    EXPECT_TRUE(fs::exists(folder / apart / "result.json"));
    EXPECT_TRUE(fs::exists(folder / apart / "curve.csv"));
  }
  EXPECT_EQ(test::contents(folder / "out/curve.csv"), "mine");
  EXPECT_EQ(entries(folder / "out"), 3U);
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out/results --force").exit_code, 0);
}

// A folder may be a disk of its own: what is staged is staged in it.
TEST(OutputFolder, ThatIsThereHoldsWhatIsStaged) {
  const fs::path folder = test::folder_with_scene();
  fs::create_directories(folder / "out/.partial/killed");
  EXPECT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "out/result.json"));
  EXPECT_FALSE(fs::exists(folder / "out/.partial"));
}

TEST(OutputFolder, ThatCannotBeMadeIsNamed) {
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, "simulate scene.toml -o /proc/none/out");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(answer.err.starts_with("havers: /proc/none/out: cannot be written: ")) << answer.err;
}

// A build without pages leaves none; one that another build adds is not the user's.
TEST(OutputFolder, KnowsAPageThatWasAdded) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_tests();
  const int answer = run_havers(folder, "fit made/study.toml -o out").exit_code;
  std::string names = test::contents(folder / "out/.havers");
  const std::size_t page = names.find("report.html\n");
  if (page == std::string::npos) GTEST_SKIP() << "this build makes no pages";
  test::write_text(folder / "out/.havers", names.erase(page, 12));
  fs::remove(folder / "out/report.html");
  ASSERT_EQ(run_havers(folder, "report out").exit_code, 0);
  EXPECT_EQ(run_havers(folder, "fit made/study.toml -o out --force").exit_code, answer);
}

TEST(OutputFolder, MayExistWhenEmptyAndMayBeDeep) {
  const fs::path folder = test::folder_with_scene();
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
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, "simulate scene.toml -o scene.toml --force");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(test::contents(folder / "scene.toml"), test::small_scene());
  fs::create_symlink("nowhere", folder / "link");
  EXPECT_THAT(run_havers(folder, "simulate scene.toml -o link").err,
              HasSubstr("link: is a link that leads nowhere (give another folder"));
}

// Above what a link leads to, as the kernel has it, and not where the link is.
TEST(OutputFolder, IsFoundBehindALinkAsTheKernelFindsIt) {
  const fs::path folder = test::folder_with_scene();
  fs::create_directories(folder / "there/below");
  fs::create_directory_symlink("there/below", folder / "link");
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o link/../out").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "there/out/result.json"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

// Its list of names has a line each.
TEST(OutputFolder, KeepsAFileThatIsPartOfANameWithALineBreak) {
  const fs::path folder = test::folder_with_tests();
  fs::copy_file(folder / "made/B0.csv", folder / "thesis\nB0.csv");
  ASSERT_EQ(run_havers(folder, "import 'thesis\nB0.csv' -o out").exit_code, 0);
  test::write_text(folder / "out/thesis", "mine");
  EXPECT_EQ(run_havers(folder, "import made/B0.csv -o out --force").exit_code, 0);
  EXPECT_EQ(test::contents(folder / "out/thesis"), "mine");
  fs::rename(folder / "study.toml", folder / "a\nb.toml");
  EXPECT_THAT(run_havers(folder, "sweep 'a\nb.toml' -o swept").err,
              HasSubstr("has a line break in its name (rename it"));
}

}  // namespace
}  // namespace havers
