// Porosity of a bone section from its image (OpenCV inside).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/porosity/method_comparison.hpp"
#include "calib/porosity/section_porosity.hpp"

namespace havers::io {

/// Whether pores are darker or brighter than bone; found where not known.
enum class Pores { found, dark, bright };

/// Where pores end: half way between bone and pores, undoing the blur; or by a rule of the trade.
enum class Threshold { half_maximum, otsu, sauvola };

/// A material of known density in the image: its grey level, or the pixels that show it.
struct DensityReference {
  double grey = 0.0;     ///< [grey levels of the file]
  int x = 0, y = 0;      ///< Upper left corner of a rectangle that shows it. [px]
  int width = 0;         ///< 0: `grey` is given instead. [px]
  int height = 0;        ///< [px]
  double density = 0.0;  ///< [kg/m³]
};

/// How a section is measured. By default the pixel size is the file's own, and bone and pores are
/// found in the image.
struct SectionOptions {
  std::optional<double> pixel_size = std::nullopt;  ///< Default: the file's own tag. [m]
  bool any_pixel_size = false;    ///< Whether sizes outside 0.1 to 200 µm are meant.
  double window_length = 100e-6;  ///< L of the fibre whose window spreads porosity. [m]
  double window_height = 10e-6;   ///< l. [m]
  std::optional<std::filesystem::path> mask =
      std::nullopt;          ///< White where the bone is; default: found.
  bool fills_image = false;  ///< Whether bone is everywhere, so that no outline is looked for.
  Pores pores = Pores::found;
  Threshold threshold = Threshold::half_maximum;
  double rim = 0.0;                 ///< Depth of bone left out below its surfaces. [m]
  double crack_slenderness = 10.0;  ///< Length over width of a crack; 0: cracks are pores. [-]
  std::vector<DensityReference> density = {};  ///< At least two; more have a residual.
  bool pictures = true;                        ///< Whether to draw overlay and histogram.
};

/// One section: its numbers, and the pictures of them if these are asked for.
struct SectionMeasurement {
  calib::SectionPorosity porosity;
  std::vector<std::uint8_t>
      overlay_png;  ///< The section with bone outline and pores drawn in; may be scaled down.
  calib::DepthHistogram histogram;
};

/// Whether this build can read images.
bool images_available();

/// Measures sections: PNG, TIFF (a section a page), JPEG, BMP or DICOM; 8 or 16 bit; grey or
/// colour.
/// @throws InputError when the file cannot be read or holds no bone; or when images are not built
/// in.
std::vector<SectionMeasurement> measure_sections(const std::filesystem::path& image,
                                                 const SectionOptions& options);

/// What to draw for a synthetic section.
struct SectionDrawing {
  int pixels = 400;           ///< Side of the image.
  double pixel_size = 2e-6;   ///< [m]
  double porosity = 0.05;     ///< Aimed at; the drawn one is returned. [-]
  double pore_radius = 8e-6;  ///< Mean radius. [m]
  bool ring = false;          ///< A ring with a marrow cavity instead of a machined bar.
  double noise = 0.01;        ///< SD of the grey levels, bone − pore = 1. [-]
  double shading = 0.1;       ///< Loss of brightness from centre to corner. [-]
  double blur = 1.0;          ///< Of the optics. [px]
  double contrast = 1.0;      ///< Bone − pore, over that of a good photograph. [-]
  bool stain = false;         ///< In colour, red and blue different.
  std::uint64_t seed = 1;
};

/// Draws a section as PNG and returns its true porosity quantities, counted on the drawn pores
/// without noise.
calib::SectionPorosity draw_section(const std::filesystem::path& image,
                                    const SectionDrawing& drawing, const SectionOptions& options);

/// An 8-bit image with dark pores by the first three of calib::PorosityMethod.
std::array<calib::PorosityReading, 3> measure_by_common_practice(
    const std::filesystem::path& image);

}  // namespace havers::io
