// import, and what it says of good and bad test files.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/machine/read_test.hpp"
#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::folder_with_tests;
using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

TEST(Import, GivesBackWhatSynthesizePutIn) {
  const fs::path folder = folder_with_tests();
  const auto truth = nlohmann::json::parse(test::contents(folder / "made/truth.json"));
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

// "files" holds every file, read or not; where one was asked for, what it has stands beside it.
TEST(Import, AnswersInOneShapeForAnyNumberOfFiles) {
  const fs::path folder = folder_with_tests();
  const auto json = [&](const std::string& files) {
    return nlohmann::json::parse(run_havers(folder, "import " + files + " --json").out);
  };
  const auto missing = json("none.csv"), one = json("made/B0.csv");
  EXPECT_THAT(missing["files"][0]["error"].get<std::string>(),
              testing::StartsWith("none.csv: there is no such file"));
  EXPECT_EQ(missing["error"], missing["files"][0]["error"]);
  ASSERT_EQ(one.at("files").size(), 1U);
  EXPECT_EQ(one["files"][0]["strength_Pa"], one["strength_Pa"]);
  const auto both = json("none.csv made/B0.csv");
  EXPECT_EQ(both.size(), 1U) << both.dump();
  EXPECT_EQ(both["files"], nlohmann::json({missing["files"][0], one["files"][0]}));
}

TEST(Import, ShowsTheReadableFilesAndNamesTheOthers) {
  const fs::path folder = folder_with_tests();
  test::write_text(folder / "empty.csv", "");
  const auto answer = run_havers(folder, "import made/B0.csv empty.csv");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.out, HasSubstr("B0.csv"));
  EXPECT_THAT(answer.err, HasSubstr("empty.csv"));
}

std::string million_columns() {
  std::string row;
  for (int i = 0; i < 1'000'000; ++i) row += "1,";
  return row + "\n";
}

// One sentence that names the file, nothing on stdout, exit 2.
TEST(Import, RefusesEveryBadFileInOneSentence) {
  const fs::path folder = own_folder();
  const std::string header = "Time (s),Load (N),Extension (mm)\n0,1,2\n1,2,3\n";
  const std::vector<std::pair<const char*, std::string>> bad{
      {"empty.csv", ""},
      {"binary.csv", std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16)},
      {"truncated.csv", header + "2,3"},
      {"nan.csv", header + "2,NaN,4\n"},
      {"overflow.csv", header + "2,1e999,4\n"},
      {"quote.csv", header + "2,\"3,4\n3,4,5\n"},
      {"time.csv", header + "0.5,3,4\n"},
      {"columns.csv", million_columns()}};
  for (const auto& [name, content] : bad) test::write_text(folder / name, content);
  test::write_text(folder / "large.csv", header);
  fs::resize_file(folder / "large.csv", 2'000'000'000);  // sparse
  fs::create_directory(folder / "folder.csv");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const auto answer = run_havers(folder, "import " + name);
    EXPECT_EQ(answer.exit_code, 2) << name;
    EXPECT_EQ(answer.out, "") << name;
    EXPECT_EQ(std::ranges::count(answer.err, '\n'), 1) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr(name));
  }
}

// The gauge's columns as a logger would have written them, 5.5 s later on its own clock.
void split_off_logger(const fs::path& folder) {
  const fs::path whole = folder / "made/B0.csv";
  const io::TestFile file = io::read_test(whole);
  std::string machine = "Width,4.0,mm\nThickness,2.0,mm\n\nTime (s),Load (N)\n";
  std::string logger = "Time (s),Strain\n";
  const double end = file.test.time.back() + 3.0;
  const auto add = [&](double time, double force, double strain) {
    machine += fmt::format("{},{}\n", time, force);
    logger += fmt::format("{},{}\n", time + 5.5, strain);
  };
  for (std::size_t i = 0; i < file.rows; ++i)
    add(file.test.time[i], file.test.force[i], file.test.strain[i]);
  for (double time = file.test.time.back() + 0.1; time < end; time += 0.1) add(time, 0.0, 0.0);
  test::write_text(folder / "machine.csv", machine);
  test::write_text(folder / "logger.csv", logger);
}

TEST(Import, JoinsASecondLogger) {
  const fs::path folder = folder_with_tests();
  split_off_logger(folder);
  const auto whole = nlohmann::json::parse(run_havers(folder, "import made/B0.csv --json").out);
  const auto answer = run_havers(folder, "import machine.csv --gauge logger.csv --json -o clocks");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const auto joined = nlohmann::json::parse(answer.out);
  const auto& clocks = joined["clocks"];
  const double error = clocks["machine_time_at_reference_s"].get<double>() -
                       (clocks["reference_s"].get<double>() - 5.5);
  EXPECT_LT(std::abs(error), 0.1) << clocks.dump();
  EXPECT_LT(std::abs(error), 3.0 * clocks["machine_time_standard_error_s"].get<double>())
      << clocks.dump();
  // Both clocks run alike; at its own 0 the logger is 5.5 s before the machine's.
  EXPECT_NEAR(clocks["rate"].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(clocks["offset_s"].get<double>(), -5.5, 0.3) << clocks.dump();
  EXPECT_NEAR(joined["modulus_Pa"].get<double>() / whole["modulus_Pa"].get<double>(), 1.0, 0.02);
  EXPECT_TRUE(fs::exists(folder / "clocks/import.json"));
}

// Of clocks that are not known nothing is shown, and what was noticed before is.
TEST(Import, ShowsNoClocksWhereALoggerCannotBeJoined) {
  const fs::path folder = folder_with_tests();
  split_off_logger(folder);
  test::write_text(folder / "short.csv", "Time (s),Strain\n0,0\n1,0.001\n2,0.002\n");
  const auto answer = run_havers(folder, "import machine.csv --gauge short.csv --json -o out");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.err.find("there are too few rows"), std::string::npos) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_FALSE(json.contains("clocks"));
  EXPECT_NE(json["warnings"].dump().find("has no unit, taken as mm/mm"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "out/clocks.svg"));
}

TEST(Import, TakesWhatAStudyCouldSay) {
  const fs::path folder = folder_with_tests();
  const auto corrections = [&](const std::string& options) {
    const auto answer = run_havers(folder, "import made/B0.csv --json " + options);
    return nlohmann::json::parse(answer.out).at("corrections").dump();
  };
  EXPECT_THAT(corrections(""), HasSubstr("toe"));
  EXPECT_THAT(corrections("--set reduction.remove_toe=false"), testing::Not(HasSubstr("\"toe\"")));
  EXPECT_THAT(run_havers(folder, "import made/B0.csv --set reduction.remove_to=1").err,
              HasSubstr("remove_toe"));
  test::write_text(folder / "bare.csv", "0,1\n1,2\n2,3\n");
  EXPECT_THAT(
      run_havers(folder, "import bare.csv").err,
      HasSubstr("(say which is which by --set columns.KEY=VALUE; from the numbers it may "));
  const auto named = run_havers(
      folder, "import bare.csv --set columns.force=2 --set columns.force_unit=kN --json");
  EXPECT_EQ(nlohmann::json::parse(named.out).at("columns").at(1).at("quantity"), "force");
}

// Of whatever folders the files are, and whatever their names look like with a number.
TEST(Import, DrawsEveryFileEvenOfOneName) {
  const fs::path folder = own_folder();
  if (run_havers(folder, "--version").out.find("reports OFF") != std::string::npos)
    GTEST_SKIP() << "this build makes no figures";
  std::string files;
  for (const char* name : {"a/t.csv", "b/t.csv", "b/t_2.csv"}) {
    fs::create_directories((folder / name).parent_path());
    test::write_text(folder / name, "Time (s),Load (N)\n0,1\n1,2\n2,3\n");
    files += std::string(" ") + name;
  }
  run_havers(folder, "import" + files + " -o out");
  for (const char* figure : {"t.svg", "t_2.svg", "t_2_2.svg"})
    EXPECT_TRUE(fs::exists(folder / "out" / figure)) << figure;
}

// What is not known is null, and what was read is shown.
TEST(Import, ShowsATestThatCannotBeReduced) {
  const fs::path folder = own_folder();
  test::write_text(folder / "bare.csv", "Time (s),Load (N)\n0,1\n1,2\n2,3\n");
  const auto answer = run_havers(folder, "import bare.csv --json -o out");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--width-mm"));
  EXPECT_TRUE(nlohmann::json::parse(answer.out)["strength_Pa"].is_null());
  EXPECT_TRUE(fs::exists(folder / "out/import.json"));
  // No size makes up for a channel.
  EXPECT_EQ(run_havers(folder, "import bare.csv --width-mm 4 --thickness-mm 2").err,
            "havers: bare.csv: neither strain nor crosshead extension was read\n");
}

TEST(Study, LeavesOutASpecimenThatCannotBeUsedAndSaysWhy) {
  const fs::path folder = folder_with_tests();
  test::write_text(folder / "made/B90.csv",
                   "Width,4,mm\nThickness,2,mm\n\nTime (s),Load (N),Strain\n0,0,0\n1,1,1e-6\n");
  const auto answer = run_havers(folder, "check made/study.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("specimen B90 is left out: 2 rows are too few"));
  const auto fitted = run_havers(folder, "fit made/study.toml -o out");
  EXPECT_THAT(fitted.out, HasSubstr("warn tests used: Left out: specimen B90 (2 rows are too few"));
  const auto none = run_havers(folder, "check made/study.toml --set reduction.largest_noise=1e-12");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no specimen is left to fit"));
}

// A study has many files, and the file's own words do not say which this is.
TEST(Study, SaysOfWhichSpecimenAFaultyFileIs) {
  const bool images = test::reads_images();
  const fs::path folder = folder_with_tests();
  test::write_text(folder / "made/B90.csv", "");
  EXPECT_THAT(run_havers(folder, "check made/study.toml").err,
              HasSubstr("B90.csv: the file is empty (it is the test of specimen B90)\n"));
  if (!images) GTEST_SKIP() << "this build reads no images";
  test::write_text(folder / "made/none.png", "no image");
  test::write_text(folder / "made/study.toml",
                   test::small_study() + "sections = [\"none.png\"]\npixel_size_um = 5\n");
  EXPECT_THAT(run_havers(folder, "check made/study.toml").err,
              HasSubstr("; it is the section of specimen B90)\n"));
}

// Above what a link leads to; the same test by another name is the same.
TEST(Study, FindsItsFilesBehindALinkAsTheKernelDoes) {
  const fs::path folder = test::folder_with_tests();
  fs::create_directories(folder / "made/deep");
  fs::create_directory_symlink("made/deep", folder / "link");
  const std::string study = test::replaced_once(test::small_study(), "\"B0.csv\"", "\"../B0.csv\"");
  test::write_text(folder / "made/deep/study.toml",
                   test::replaced_once(study, "\"B90.csv\"", "\"../../made/B0.csv\""));
  const auto answer = run_havers(folder, "check link/study.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("B0 and B90 have the same test"));
}

// As of one in a folder that is closed; it hides no other problem.
TEST(Study, SaysWhyAFileCannotBeRead) {
  const fs::path folder = test::folder_with_study();
  test::write_text(folder / "study.toml",
                   test::replaced_once(test::small_study(), "B0.csv", std::string(300, 'x')));
  const auto answer = run_havers(folder, "check study.toml");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("x, which cannot be read: "));
  EXPECT_THAT(answer.err, HasSubstr("names B90.csv, which is not there"));
}

TEST(Import, AsksForSizesOnlyWhereSomeAreLacking) {
  const fs::path folder = own_folder();
  test::write_text(folder / "short.csv", "Time (s),Load (N),Strain (%)\n0,0,0\n1,2,0.1\n2,5,0.2\n");
  EXPECT_THAT(run_havers(folder, "import short.csv").err, HasSubstr("--width-mm"));
  EXPECT_EQ(run_havers(folder, "import short.csv --width-mm 4 --thickness-mm 2").err,
            "havers: short.csv: 3 rows are too few\n");
}

// Whose squares leave the range of numbers.
TEST(Import, HasADashForWhatIsNotKnown) {
  const fs::path folder = own_folder();
  std::string table = "Width,4,mm\nThickness,2,mm\n\nTime (s),Load (N),Strain\n";
  for (int i = 0; i <= 400; ++i)
    table += fmt::format("{},{}.{}e200,{:.6f}\n", i, 2 * i, i % 7, 2e-5 * i);
  test::write_text(folder / "huge.csv", table + "401,0,0\n");
  const auto answer = run_havers(folder, "import huge.csv");
  EXPECT_THAT(answer.out, HasSubstr("+- - GPa"));
  EXPECT_THAT(answer.out, testing::Not(HasSubstr("nan")));
}

TEST(Import, TakesSizesFromTheCommandLine) {
  const fs::path folder = folder_with_tests();
  const auto answer = run_havers(folder, "import made/B0.csv --width-mm 8 --json");
  EXPECT_NEAR(nlohmann::json::parse(answer.out)["area_m2"].get<double>(), 16e-6, 1e-12)
      << answer.err;
}

// 15 GPa on 25 mm; the header says 50 mm or nothing.
TEST(Import, TakesTheGivenGaugeLengthForAnElongation) {
  const fs::path folder = own_folder();
  std::string table = "Time (s),Load (N),Strain (mm)\n";
  for (int i = 0; i <= 100; ++i)
    table += fmt::format("{:.1f},{},{:.5f}\n", 0.1 * i, 6 * i, 0.25 * 0.005 * i);
  table += "10.2,0,0\n";
  const std::string sizes = "Width,4,mm\nThickness,2,mm\n";
  test::write_text(folder / "stated.csv", sizes + "Gauge length,50,mm\n\n" + table);
  test::write_text(folder / "silent.csv", sizes + "\n" + table);
  for (const std::string name : {"stated.csv", "silent.csv"}) {
    const auto answer = run_havers(folder, "import " + name + " --gauge-length-mm 25 --json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const auto json = nlohmann::json::parse(answer.out);
    EXPECT_NEAR(json["modulus_Pa"].get<double>(), 15e9, 1e6) << answer.out;
  }
}

}  // namespace
}  // namespace havers
