// Only in a build without images.
#include <gtest/gtest.h>

#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"

namespace havers::io {
namespace {

TEST(ImagesLeftOut, SayHowToGetThem) {
  EXPECT_FALSE(images_available());
  try {
    measure_sections("section.png", {});
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("section.png: images are not built into this havers"),
              std::string::npos);
    EXPECT_NE(std::string(error.what()).find("-DHAVERS_IMAGES=ON"), std::string::npos);
  }
  EXPECT_THROW(draw_section("section.png", {}, {}), InputError);
}

}  // namespace
}  // namespace havers::io
