// A build without its optional parts says how to get them and exits 2.
#include <gmock/gmock.h>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

TEST(Lean, SaysHowToGetWhatIsNotBuiltIn) {
  const auto folder = test::own_folder();
  test::write_text(folder / "section.png", "");
  for (const char* arguments : {"porosity section.png --pixel-size-um 5", "report ."}) {
    const auto answer = test::run_havers(folder, arguments);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_THAT(answer.err, testing::HasSubstr("apt-get install"));
  }
}

}  // namespace
}  // namespace havers
