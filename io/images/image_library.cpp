// The only function that dlsym looks up; the functions that it returns have types.
#include "io/images/image_library.hpp"

extern "C" const havers::images::ImageLibrary* havers_images() {
  static constexpr havers::images::ImageLibrary library{
      .measure_sections = havers::images::measure_sections,
      .draw_section = havers::images::draw_section,
      .measure_by_common_practice = havers::images::measure_by_common_practice};
  return &library;
}
