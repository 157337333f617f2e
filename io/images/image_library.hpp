// What the library libhavers_images offers. It holds all of OpenCV's users and is loaded with the
// first image, so that a run without images starts without OpenCV.
#pragma once

#include <array>

#include "io/images/measure_section.hpp"

namespace havers::images {

/// As their namesakes of io/images/measure_section.hpp, which call them.
std::vector<io::SectionMeasurement> measure_sections(const std::filesystem::path& image,
                                                     const io::SectionOptions& given);
calib::SectionPorosity draw_section(const std::filesystem::path& image,
                                    const io::SectionDrawing& drawing,
                                    const io::SectionOptions& options);

std::array<calib::PorosityReading, 3> measure_by_common_practice(
    const std::filesystem::path& image);

/// The library's functions with their types: only one name has to be looked up at run time, and the
/// compiler checks all calls.
struct ImageLibrary {
  decltype(&images::measure_sections) measure_sections;
  decltype(&images::draw_section) draw_section;
  decltype(&images::measure_by_common_practice) measure_by_common_practice;
};

}  // namespace havers::images

/// The library's one exported name.
extern "C" const havers::images::ImageLibrary* havers_images();
