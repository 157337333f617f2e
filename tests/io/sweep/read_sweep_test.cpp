#include "io/sweep/read_sweep.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "tests/io/complaints.hpp"
#include "tests/io/sweep/small_sweep.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ReadSweep : public testing::Test {
 protected:
  SweepFile read(const std::string& text, const Overrides& overrides = {}) {
    return read_sweep(folder.write("s.toml", text), overrides);
  }
  std::vector<std::string> complaints(const std::string& text, const Overrides& overrides = {}) {
    return test::complaints_of(folder, [&] { read(text, overrides); });
  }

  test::ScratchFolder folder;
};

TEST_F(ReadSweep, SaysWhichKeysChangeNothing) {
  EXPECT_THAT(read(test::small_sweep).warnings, testing::IsEmpty());
  EXPECT_THAT(read(test::small_sweep, {"joints.seed=3", "sweep.points=9"}).warnings,
              ElementsAre(HasSubstr("joints.seed changes nothing: sweep.seed"),
                          HasSubstr("sweep.points changes nothing: a list or a grid")));
  EXPECT_THAT(read(test::small_sweep, {"sweep.seeds=1"}).warnings,
              ElementsAre(HasSubstr("sweep.seeds is 1: no finding can be decided")));
  const std::string sample =
      "[sweep]\nsample = \"sobol\"\npoints = 9\nkeys.\"joints.scatter\" = [0.2, 0.8]\n";
  EXPECT_THAT(read(sample).warnings, testing::IsEmpty());
}

TEST_F(ReadSweep, SaysWhichVariedKeysTheLimitDoesNotKnow) {
  const std::string text = "[sweep.keys]\n\"solver.step_s\" = [1e-8, 2e-8]\n";
  EXPECT_THAT(read(text).warnings, testing::IsEmpty());
  EXPECT_THAT(
      read(text, {"solver.regime=quasi-static"}).warnings,
      ElementsAre(HasSubstr("sweep.keys.\"solver.step_s\" changes nothing: solver.regime")));
  EXPECT_THAT(read(text + "\"solver.regime\" = [\"quasi-static\", \"dynamic\"]\n").warnings,
              testing::IsEmpty());
}

// TOML keeps no order: the keys are in that of the alphabet.
TEST_F(ReadSweep, MakesASceneOfEveryPoint) {
  const calib::Sweep sweep = read(test::small_sweep).sweep;
  EXPECT_EQ(sweep.name, "Small");
  EXPECT_EQ(sweep.plan.seeds, 3);
  ASSERT_EQ(sweep.points.size(), 4U);
  EXPECT_EQ(sweep.points[3].scene.assembly.layers, 4);
  EXPECT_EQ(sweep.points[3].scene.joints.scatter, 0.8);
  EXPECT_EQ(sweep.points[3].scene.joints.distribution, sim::Distribution::weibull);
  EXPECT_EQ(sweep.points[3].numbers[1], 0.8);
  EXPECT_TRUE(std::isnan(sweep.points[3].numbers[0]));
  EXPECT_EQ(sweep.laws.size(), 1U);
  EXPECT_EQ(sweep.findings.front().test, calib::FindingTest::falls);
  EXPECT_EQ(sweep.figures.front().x, "joints.scatter");
}

TEST_F(ReadSweep, NamesEveryFileThatItReadOnce) {
  const auto joints = folder.write("joints.csv", "joint,f_N,f_T\n0,3,4\n");
  const auto file = folder.write("s.toml", R"([sweep]
seeds = 1
[sweep.keys]
"joints.friction" = [0.1, 0.2]
[assembly]
layers = 1
fibres = 2
[joints]
thresholds_file = "joints.csv"
)");
  EXPECT_THAT(read_sweep(file).inputs, ElementsAre(file, joints));
}

TEST_F(ReadSweep, TakesTheSeedOfTheCommandLine) {
  EXPECT_EQ(read_sweep(folder.write("s.toml", test::small_sweep), {}, 7).sweep.plan.seed, 7U);
}

TEST_F(ReadSweep, NamesAnImpossibleValueOnceAndByTheSweepsKey) {
  EXPECT_THAT(complaints("[sweep.keys]\n\"joints.scatter\" = [0.2, 2.5]\n"
                         "\"assembly.layers\" = [3, 4]\n"),
              ElementsAre(HasSubstr("s.toml: sweep.keys.\"joints.scatter\"")));
}

// A table that no scene of a sweep has, and a key without its quotes.
TEST_F(ReadSweep, BlamesTheSweepsKeysForTheirTables) {
  EXPECT_THAT(
      complaints("[sweep.keys]\n\"output.snapshots\" = [1, 2]\n"),
      ElementsAre(HasSubstr("s.toml: sweep.keys.\"output.snapshots\": is not a known key")));
  EXPECT_THAT(complaints("[sweep.keys]\njoints.scatter = [0.2, 0.4]\n"),
              testing::Contains("s.toml:2: sweep.keys.joints: is a table, must be a list (quote a "
                                "key with dots, as in \"joints.scatter\" = [0.2, 0.4])"));
}

TEST_F(ReadSweep, NamesUnknownKeysAndQuestionsAboutWhatDoesNotVary) {
  EXPECT_THAT(complaints("[sweep.keys]\n\"joints.scater\" = [0.2]\n"
                         "[[law]]\nterms = [\"joints.ratio\"]\n"
                         "[[finding]]\ntest = \"same\"\n"),
              testing::UnorderedElementsAre(HasSubstr("did you mean scatter?"),
                                            HasSubstr("joints.ratio, which does not vary"),
                                            HasSubstr("finding.keys: is missing")));
}

TEST_F(ReadSweep, NamesMistypedKeysOfSweepAndSceneTogether) {
  EXPECT_THAT(complaints("[sweep]\nseds = 3\n[sweep.keys]\n\"joints.scater\" = [0.2, 0.4]\n"
                         "[assembly]\nfibers = 3\n",
                         {"joints.scater=1", "joints.ratoi=2"}),
              testing::UnorderedElementsAre(
                  HasSubstr("sweep.seds: is not a known key"),
                  HasSubstr("sweep.keys.\"joints.scater\": is not a known key"),
                  HasSubstr("assembly.fibers: is not a known key"),
                  HasSubstr("--set joints.ratoi: is not a known key"),
                  HasSubstr("--set joints.scater: sets nothing: the sweep varies it")));
}

TEST_F(ReadSweep, AsksForPatternsWhereAQuestionIsAboutThem) {
  const std::string text =
      "[sweep.keys]\n\"joints.scatter\" = [0.2]\n[[figure]]\nx = \"joints.scatter\"\n"
      "response = \"crack_span\"\n";
  EXPECT_THAT(complaints(text),
              ElementsAre(HasSubstr("figure.response: is known only where the broken joints are "
                                    "looked at (say patterns = true in [sweep])")));
  EXPECT_NO_THROW(read("[sweep]\npatterns = true\n" + text));
}

// Words have no order, and no place on an axis.
TEST_F(ReadSweep, AsksForNumbersWhereAQuestionIsAboutThem) {
  const std::string text = "[sweep.keys]\n\"joints.distribution\" = [\"uniform\", \"weibull\"]\n";
  const auto refused =
      ElementsAre(HasSubstr("names joints.distribution, whose values are no numbers"));
  EXPECT_THAT(complaints(text + "[[law]]\nterms = [\"joints.distribution\"]\n"), refused);
  EXPECT_THAT(
      complaints(text + "[[finding]]\ntest = \"rises\"\nkeys = [\"joints.distribution\"]\n"),
      refused);
  EXPECT_THAT(complaints(text + "[[figure]]\nx = \"joints.distribution\"\n"), refused);
  EXPECT_THAT(complaints(text + "[[finding]]\ntest = \"same\"\nkeys = [\"joints.distribution\"]\n"),
              testing::IsEmpty());
}

// A line has several terms; a difference is judged over one key, the others held.
TEST_F(ReadSweep, AsksForOneKeyWhereAQuestionIsAboutOne) {
  const std::string text =
      "[sweep.keys]\n\"joints.scatter\" = [0.2, 0.4]\n\"joints.friction\" = [0.1, 0.2]\n"
      "[[finding]]\nkeys = [\"joints.scatter\", \"joints.friction\"]\ntest = ";
  for (const char* test : {"\"same\"", "\"matters\"", "\"rises\"", "\"falls\""})
    EXPECT_THAT(complaints(text + test),
                ElementsAre("s.toml:5: finding.keys: names 2 keys, of which one is judged (give "
                            "each a finding of its own)"));
  EXPECT_THAT(complaints(text + "\"linear\""), testing::IsEmpty());
}

TEST_F(ReadSweep, RefusesAFindingThatComparesNothing) {
  const std::string finding = "[[finding]]\ntest = \"falls\"\nkeys = [\"joints.scatter\"]\n";
  const std::string one = "[sweep]\n[sweep.keys]\n\"joints.scatter\" = [0.2, 0.4]\n";
  const std::string two = one + "\"joints.friction\" = [0.1, 0.2]\n" + finding;
  EXPECT_THAT(complaints(two, {"sweep.sample=sobol"}),
              ElementsAre("s.toml: finding.keys: names joints.scatter, but no two points differ in "
                          "it alone (use sample = \"grid\" or \"list\")"));
  EXPECT_THAT(complaints(two, {"sweep.sample=list"}), testing::IsEmpty());
  EXPECT_THAT(
      complaints(two + "per = \"joints.friction\"\n", {"sweep.sample=list"}),
      ElementsAre("s.toml: finding.keys: names joints.scatter, but at joints.friction = 0.1 "
                  "no two points differ in it alone (give it more values at which the "
                  "other keys are alike)"));
  EXPECT_THAT(complaints(two + "per = \"joints.scatter\"\n"),
              ElementsAre(HasSubstr("(name another key as per)")));
  EXPECT_THAT(complaints(one + finding, {"sweep.keys.\"joints.scatter\"=[0.3]"}),
              ElementsAre(HasSubstr("no two points differ in it alone")));
  EXPECT_THAT(complaints(one + "[[finding]]\ntest = \"linear\"\nkeys = [\"joints.scatter\"]\n",
                         {"sweep.keys.\"joints.scatter\"=[0.3]"}),
              ElementsAre(HasSubstr("the points are too few or too alike to try a line by")));
  EXPECT_THAT(complaints(one + "[[finding]]\ntest = \"linear\"\nkeys = [\"joints.scatter\"]\n"),
              ElementsAre(HasSubstr("the points are too few or too alike to try a line by")));
}

// However wrong the scene is: all is said at once.
TEST_F(ReadSweep, RefusesAFindingThatComparesNothingBesideAnotherMistake) {
  EXPECT_THAT(complaints(test::small_sweep, {"sweep.keys.\"joints.scatter\"=[3.0]"}),
              testing::UnorderedElementsAre(HasSubstr("sweep.keys.\"joints.scatter\": is 3"),
                                            HasSubstr("no two points differ in it alone")));
}

TEST_F(ReadSweep, DrawsNothingBesideGivenThresholds) {
  folder.write("t.csv", "joint,f_N,f_T\n0,1,1\n1,1,1\n2,1,1\n");
  const std::string text =
      "[assembly]\nlayers = 2\nfibres = 1\n[joints]\nthresholds_file = \"t.csv\"\n[sweep]\n";
  const std::string friction = "keys.\"joints.friction\" = [0.1, 0.2]\n";
  EXPECT_THAT(complaints(text + "seeds = 1\n" + friction), testing::IsEmpty());
  EXPECT_THAT(complaints(text + "seeds = 3\n" + friction),
              ElementsAre(HasSubstr("sweep.seeds: asks for draws that joints.thresholds_file")));
  EXPECT_THAT(complaints(text + "seeds = 1\nlevels = 2\n" + friction),
              ElementsAre(HasSubstr("sweep.levels: asks for draws")));
  EXPECT_THAT(complaints(text + "seeds = 1\nkeys.\"joints.scatter\" = [0.1, 0.2]\n"),
              ElementsAre(HasSubstr("joints.scatter changes nothing beside")));
}

TEST_F(ReadSweep, NamesAMarginThatCannotBe) {
  const std::string text =
      "[sweep.keys]\n\"joints.scatter\" = [0.2, 0.5]\n[[finding]]\n"
      "keys = [\"joints.scatter\"]\nmargin = -1\ntest = ";
  EXPECT_THAT(complaints(text + "\"same\"\n"),
              ElementsAre(HasSubstr("finding.margin: is -1, must be at least 0 and less than 1")));
  EXPECT_THAT(complaints(text + "\"same\"\n", {"finding=[{test=\"same\",margin=5}]"}),
              testing::Contains(HasSubstr("margin: is 5, must be at least 0 and less than 1")));
  EXPECT_NO_THROW(read(text + "\"above\"\n"));
}

// A level that nobody named would be 0.05 Pa.
TEST_F(ReadSweep, AsksForTheLevelThatAMeanIsToBeAbove) {
  EXPECT_THAT(complaints("[sweep.keys]\n\"joints.scatter\" = [0.2, 0.5]\n[[finding]]\n"
                         "test = \"above\"\n"),
              ElementsAre(HasSubstr("finding.margin: is missing (give the level")));
}

TEST_F(ReadSweep, RefusesASettingOfAKeyThatVaries) {
  for (const char* setting : {"joints.scatter = 0.3", "joints = {scatter = 0.3}"})
    EXPECT_THAT(complaints(test::small_sweep, {setting}),
                ElementsAre("--set joints.scatter: sets nothing: the sweep varies it (--set "
                            "'sweep.keys.\"joints.scatter\"=[...]' gives its values)"));
  EXPECT_EQ(
      read(test::small_sweep, {"sweep.keys.\"joints.scatter\"=[0.3,0.4,0.5]"}).sweep.points.size(),
      6U);
}

TEST_F(ReadSweep, RefusesAFileWithoutKeys) {
  EXPECT_THAT(complaints("# nothing yet\n"), ElementsAre(HasSubstr("s.toml: is empty (")));
}

TEST_F(ReadSweep, NamesWhatIsWrongWithThePlan) {
  EXPECT_THAT(complaints("[sweep]\nseeds = 0\n"),
              ElementsAre("s.toml:1: sweep.keys: names no keys to vary",
                          "s.toml:2: sweep.seeds: is 0, must be 1 or more"));
}

TEST_F(ReadSweep, NamesKeysThatCannotVary) {
  EXPECT_THAT(complaints("[sweep.keys]\n\"joints.seed\" = [1, 2]\n\"sweep.seeds\" = [2, 3]\n"),
              testing::IsSupersetOf(
                  {HasSubstr("joints.seed cannot vary"), HasSubstr("sweep.seeds cannot vary")}));
}

}  // namespace
}  // namespace havers::io
