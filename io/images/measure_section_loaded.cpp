// Passes on to libhavers_images, loaded with the first image.
#include <dlfcn.h>

#include <array>

#include "io/images/image_library.hpp"
#include "io/input_error.hpp"

namespace havers::io {
namespace {

// Found by the program's run path: beside it, or in lib/havers of an installation.
const images::ImageLibrary* load() {
  void* library = dlopen("libhavers_images.so", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw InputError("images", dlerror(), "keep libhavers_images.so where it was installed");
  return reinterpret_cast<decltype(&havers_images)>(dlsym(library, "havers_images"))();
}

const images::ImageLibrary& library() {
  // Loaded once, by whichever thread comes first, and never unloaded.
  static const images::ImageLibrary* const loaded = load();
  return *loaded;
}

}  // namespace

bool images_available() {
  return true;
}

std::vector<SectionMeasurement> measure_sections(const std::filesystem::path& image,
                                                 const SectionOptions& options) {
  return library().measure_sections(image, options);
}

calib::SectionPorosity draw_section(const std::filesystem::path& image,
                                    const SectionDrawing& drawing, const SectionOptions& options) {
  return library().draw_section(image, drawing, options);
}

std::array<calib::PorosityReading, 3> measure_by_common_practice(
    const std::filesystem::path& image) {
  return library().measure_by_common_practice(image);
}

}  // namespace havers::io
