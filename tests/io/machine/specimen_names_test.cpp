// Which of a file's specimens a name or a number means.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/input_error.hpp"
#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

// A table under each heading; the load of the first is 1 N, of the second 2 N, and so on.
std::string stacked(const std::vector<std::string>& headings) {
  std::string text;
  for (std::size_t i = 0; i < headings.size(); ++i)
    text += fmt::format("{0}\nWidth,4,mm\n\nTime (s),Load (N)\n0,{1}\n1,{1}\n", headings[i], i + 1);
  return text;
}

// The load of the specimen that is meant, or why none is.
std::string meant(const std::vector<std::string>& headings, const ReadOptions& options) {
  try {
    return fmt::format("{}", test::read_content(stacked(headings), options).test.force.front());
  } catch (const InputError& error) {
    return error.problems().front().what + "; " + error.problems().front().hint;
  }
}

TEST(SpecimenNames, AreReadInHeadings) {
  for (const std::string heading :
       {"Specimen {}", "Specimen,{}", "Specimen no.,{}", "Specimen number,{}", "Specimen: {}",
        "\"Specimen {}\",,", "Probe {}", "Probe,{}", "Probe Nr.,{}", "Éprouvette n° {}",
        "Sample,{}", "Test {}", "Specimen : Specimen label,{}", "Sample,{}\nSpecimen ID,{}"}) {
    SCOPED_TRACE(heading);
    std::vector<std::string> headings;
    for (const char* name : {"4", "2"}) headings.push_back(test::replaced(heading, "{}", name));
    EXPECT_EQ(meant(headings, {.specimen = "4"}), "1");
    EXPECT_EQ(meant(headings, {.specimen = "1"}),
              "holds no specimen \"1\"; it holds 1 \"4\", 2 \"2\"");
  }
}

TEST(SpecimenNames, GiveWayToAnId) {
  const TestFile file =
      test::read_content("Sample,7\nSpecimen 3\nSpecimen ID,A\nLoad (N),Strain (%)\n1,1\n2,2\n");
  EXPECT_EQ(file.test.specimen_id, "A");
}

TEST(SpecimenNames, AreNotNumbers) {
  const std::vector<std::string> named{"Specimen 1", "Specimen 2", "Specimen 4"};
  EXPECT_EQ(meant(named, {.specimen = "3"}),
            "holds no specimen \"3\"; it holds 1 \"1\", 2 \"2\", 3 \"4\"");
  EXPECT_EQ(meant(named, {.specimen_number = 3}), "3");
  EXPECT_EQ(meant(named, {.specimen_number = 4}), "3");
  EXPECT_EQ(meant(named, {.specimen_number = 5}),
            "holds no specimen 5; it holds 1 \"1\", 2 \"2\", 3 \"4\"");
  EXPECT_EQ(meant({"Specimen 2", "Specimen 1"}, {.specimen_number = 1}),
            "1 is the number of one specimen and another's name; a name stands in quotes; it holds "
            "1 \"2\", 2 \"1\"");
  EXPECT_EQ(test::read_content(stacked(named), {.specimen_number = 3}).test.warnings,
            std::vector<std::string>{"specimen_in_file = 3 is the number of the specimen in the "
                                     "file: its name is \"4\""});
}

TEST(SpecimenNames, AreNotInvented) {
  const std::vector<std::string> nameless{"Operator,me", "Operator,me"};
  EXPECT_EQ(meant(nameless, {}),
            "holds 2 specimens; say which by specimen_in_file, its name or number: 1, 2");
  EXPECT_EQ(meant(nameless, {.specimen = "2"}), "2");
  EXPECT_EQ(meant(nameless, {.specimen_number = 2}), "2");
  EXPECT_EQ(meant(nameless, {.specimen = "A"}), "holds no specimen \"A\"; it holds 1, 2");
  const test::TemporaryFile file(stacked(nameless));
  for (const TestFile& test : read_tests(file.path())) EXPECT_EQ(test.test.specimen_id, "");
}

}  // namespace
}  // namespace havers::io
