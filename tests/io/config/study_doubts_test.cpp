// Angles of a study that are hardly meant.
#include "io/config/study_doubts.hpp"

#include <gmock/gmock.h>

#include "tests/support/scratch_folder.hpp"

namespace havers::io {
namespace {

std::vector<std::string> doubts_about_angles(const std::vector<const char*>& degrees) {
  const test::ScratchFolder folder;
  std::string text;
  for (std::size_t i = 0; i < degrees.size(); ++i)
    text += fmt::format("[[specimen]]\nid = \"A{0}\"\ntest = \"A{0}.csv\"\norientation_deg = {1}\n",
                        i, degrees[i]);
  return read_study(folder.write("study.toml", text), {}, Files::will_be_written).warnings;
}

TEST(StudyDoubts, FindAnAngleInRadiansAmongDegrees) {
  EXPECT_THAT(doubts_about_angles({"0", "0.785", "90"}),
              testing::ElementsAre("orientation_deg of specimen A1 is 0.785, as 45 degrees are in "
                                   "radians: were radians meant?"));
  EXPECT_THAT(doubts_about_angles({"-1.047", "45"}),
              testing::ElementsAre(testing::HasSubstr("is -1.047, as -60 degrees")));
  EXPECT_THAT(doubts_about_angles({"0", "0.785", "1.57"}),
              testing::ElementsAre(testing::HasSubstr("the largest is 1.57")));
  EXPECT_THAT(doubts_about_angles({"0", "0.4", "1", "-1.2", "15", "90"}), testing::IsEmpty());
}

}  // namespace
}  // namespace havers::io
