#include "io/images/image_library.hpp"

extern "C" const havers::images::ImageLibrary* havers_images() {
  static constexpr havers::images::ImageLibrary library{
      .measure_section = havers::images::measure_section,
      .draw_section = havers::images::draw_section};
  return &library;
}
