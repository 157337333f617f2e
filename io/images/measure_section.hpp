// Porosity of a bone section from its image (OpenCV inside).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/porosity/section_porosity.hpp"

namespace havers::io {

/// Whether pores are darker or brighter than bone; found where not known.
enum class Pores { found, dark, bright };

struct SectionOptions {
  std::optional<double> pixel_size = std::nullopt;  ///< [m]
  double window_length = 100e-6;  ///< L of the fibre whose window spreads porosity. [m]
  double window_height = 10e-6;   ///< l. [m]
  std::optional<std::filesystem::path> mask =
      std::nullopt;  ///< White where the bone is; default: found.
  Pores pores = Pores::found;
};

struct SectionMeasurement {
  calib::SectionPorosity porosity;
  std::vector<std::uint8_t>
      overlay_png;  ///< The section with bone outline and pores drawn in; may be scaled down.
};

/// Whether this build can read images.
bool images_available();

/// Measures one section: PNG, TIFF, JPEG or BMP; 8 or 16 bit; grey or colour.
/// @throws InputError when the file cannot be read or holds no bone; or when images are not built
/// in.
SectionMeasurement measure_section(const std::filesystem::path& image,
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
  std::uint64_t seed = 1;
};

/// Draws a section as PNG and returns its true porosity quantities, counted on the drawn pores
/// without noise.
calib::SectionPorosity draw_section(const std::filesystem::path& image,
                                    const SectionDrawing& drawing, const SectionOptions& options);

}  // namespace havers::io
