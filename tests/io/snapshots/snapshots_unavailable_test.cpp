#include <gmock/gmock.h>

#include "io/input_error.hpp"
#include "io/snapshots/snapshots.hpp"

namespace havers::io {
namespace {

TEST(Snapshots, SayHowToGetThemWhereTheyAreNotBuiltIn) {
  EXPECT_FALSE(snapshots_available());
  EXPECT_NO_THROW(SnapshotRecorder(0));
  try {
    const SnapshotRecorder recorder(3);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(std::string(error.what()), testing::HasSubstr("apt-get install libvtk9-dev"));
  }
  EXPECT_THROW(write_vtu("any.vtu", {}, {}, {}), InputError);
}

}  // namespace
}  // namespace havers::io
