#include <gmock/gmock.h>

#include "io/config/read_scene.hpp"
#include "io/input_error.hpp"
#include "io/snapshots/snapshots.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

TEST(Snapshots, SayHowToGetThemWhereTheyAreNotBuiltIn) {
  EXPECT_FALSE(snapshots_available());
  const test::ScratchFolder folder;
  const auto file = folder.write("s.toml", "[output]\nsnapshots = 3\n[joints]\nscater = 1\n");
  EXPECT_THAT(test::complaints_of(folder, [&] { read_scene(file, {}, Snapshots::written); }),
              testing::UnorderedElementsAre(
                  testing::HasSubstr("s.toml:2: output.snapshots: this build writes no snapshots "
                                     "for ParaView (apt-get install libvtk9-dev"),
                  testing::HasSubstr("joints.scater")));
  EXPECT_THAT(test::complaints_of(folder, [&] { read_scene(file); }), testing::SizeIs(1));
  EXPECT_NO_THROW(
      read_scene(folder.write("s.toml", "[output]\nsnapshots = 0\n"), {}, Snapshots::written));
  EXPECT_THROW(write_vtu("any.vtu", {}, {}, {}), InputError);
}

}  // namespace
}  // namespace havers::io
