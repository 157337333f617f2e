// Takes the place of the image sources in a build without OpenCV.
#include <array>

#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"

namespace havers::io {
namespace {

InputError not_built_in(const std::filesystem::path& image) {
  return {image.string(), "images are not built into this havers",
          "apt-get install libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev "
          "libdeflate-dev, then build with -DHAVERS_IMAGES=ON; or give the porosity in the study"};
}

}  // namespace

bool images_available() {
  return false;
}

std::vector<SectionMeasurement> measure_sections(const std::filesystem::path& image,
                                                 const SectionOptions& /*options*/) {
  throw not_built_in(image);
}

calib::SectionPorosity draw_section(const std::filesystem::path& image,
                                    const SectionDrawing& /*drawing*/,
                                    const SectionOptions& /*options*/) {
  throw not_built_in(image);
}

std::array<calib::PorosityReading, 3> measure_by_common_practice(
    const std::filesystem::path& image) {
  throw not_built_in(image);
}

}  // namespace havers::io
