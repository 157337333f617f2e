// Only in a build without images.
#include <gmock/gmock.h>

#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

TEST(ImagesLeftOut, SayHowToGetThem) {
  EXPECT_FALSE(images_available());
  EXPECT_THAT(
      test::refusal_of([] { measure_sections("section.png", {}); }),
      testing::AllOf(testing::HasSubstr("section.png: images are not built into this havers"),
                     testing::HasSubstr("-DHAVERS_IMAGES=ON")));
  EXPECT_THROW(draw_section("section.png", {}, {}), InputError);
}

}  // namespace
}  // namespace havers::io
