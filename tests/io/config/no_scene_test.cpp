// Files that hold no scene.
#include <gmock/gmock.h>

#include "io/config/read_scene.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class NoScene : public testing::Test {
 protected:
  std::vector<std::string> complaints(const std::string& text) {
    return test::complaints_of(folder, [&] { read_scene(folder.write("scene.toml", text)); });
  }
  test::ScratchFolder folder;
};

TEST_F(NoScene, RefusesAFileWithoutKeys) {
  for (const char* text : {"", "\n\n", "# layers = 4\n"})
    EXPECT_THAT(complaints(text),
                ElementsAre("scene.toml: is empty (a study, scene or sweep is expected there)"));
}

TEST_F(NoScene, SaysWhatTheFileIsInstead) {
  EXPECT_THAT(complaints("[study]\nname = \"A\"\n[model.joints]\nratio = 1.0\n"),
              ElementsAre("scene.toml: is a study, a scene is expected (havers fit takes it)"));
  EXPECT_THAT(complaints("[sweep]\nseeds = 3\n[joints]\nratio = 1.0\n"),
              ElementsAre("scene.toml: is a sweep, a scene is expected (havers sweep takes it)"));
}

TEST_F(NoScene, SaysWhereTheFileIsNotToml) {
  EXPECT_THAT(complaints("[joints]\nscatter = = 2\n"),
              ElementsAre(HasSubstr("scene.toml:2:11: is not TOML: ")));
  const auto test_file = folder.write("A1.csv", "Time,Load\n");
  EXPECT_THAT(test::complaints_of(folder, [&] { read_scene(test_file); }),
              ElementsAre(testing::EndsWith("(a study, scene or sweep is; havers import reads "
                                            "tests, havers porosity images)")));
}

TEST_F(NoScene, SaysWhatToDoWhereTheFileIsNotToml) {
  for (const auto& [line, hint] :
       {std::pair("young_GPa = 13,5", "(write numbers with a point, 4.02)"),
        {"[material]", "(put all keys of a table below one line of its name)"},
        {"poisson = 0.3\npoisson = 0.3", "(each key stands once in its table)"},
        {"plane = \"C:\\data\"", "(write folders with /, as in \"data/A1.csv\")"},
        {"plane = \"\\users\"", "(write folders with /, as in \"data/A1.csv\")"},
        {"young_GPa = 13 GPa", "(a key has one value, without a unit)"},
        {"plane = \"stress", "(close the text with the quote that opens it)"},
        {"young_GPa = 13.", "(write digits on both sides of the point, 13.0)"},
        {"# M\xFCller", "(save the file as UTF-8)"},
        {"plane = stress", "(write texts in straight quotes, as in \"weibull\")"},
        {"plane = “stress”", "(write texts in straight quotes, as in \"weibull\")"},
        {"plane = True", "(write true or false in small letters)"},
        {"poisson = 99999999999999999999", "(write it with fewer digits)"}})
    EXPECT_THAT(complaints("[material]\n" + std::string(line) + "\n"),
                ElementsAre(testing::EndsWith(hint)))
        << line;
  EXPECT_THAT(complaints("[specimen]\nid = \"A\"\n[specimen]\n"),
              ElementsAre(testing::EndsWith("two brackets, for each of several)")));
}

TEST_F(NoScene, SaysThatTheFileIsNotThere) {
  EXPECT_THAT(test::complaints_of(folder, [&] { read_scene(folder.path() / "none.toml"); }),
              ElementsAre("none.toml: is not there (a TOML file is expected there)"));
  EXPECT_THAT(test::complaints_of(folder, [&] { read_scene(folder.path() / "."); }),
              ElementsAre(HasSubstr(": is a folder (a TOML file is expected there)")));
}

}  // namespace
}  // namespace havers::io
