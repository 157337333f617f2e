#include "io/images/image_library.hpp"

#include <malloc.h>

extern "C" const havers::images::ImageLibrary* havers_images() {
  // Every step takes room as large as the image: to give it back to the system and fetch it again,
  // cleared, costs a sixth of the time.
  mallopt(M_MMAP_THRESHOLD, 1 << 25);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  static constexpr havers::images::ImageLibrary library{
      .measure_sections = havers::images::measure_sections,
      .draw_section = havers::images::draw_section,
      .measure_by_common_practice = havers::images::measure_by_common_practice};
  return &library;
}
