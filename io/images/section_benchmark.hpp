// Common practice and `havers porosity` on drawn sections of known porosity.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calib/porosity/method_comparison.hpp"
#include "io/images/measure_section.hpp"

namespace havers::io {

/// A section to draw, and what makes it hard to measure.
struct SectionCase {
  std::string hardship;  ///< Its name in the summary; cases of one hardship follow each other.
  SectionDrawing drawing;
};

/// Ring and bar of 0, 1, 5 and 20 % porosity under every hardship, `seeds` of each.
std::vector<SectionCase> section_cases(int seeds);

/// Draws the section into `image`, which is not deleted, and measures it in every way. CPU times
/// are those of the whole process: no other thread should work meanwhile.
/// @throws InputError as measure_sections does.
calib::PorosityTrial try_section(const SectionCase& section, const std::filesystem::path& image);

}  // namespace havers::io
