// What may be wrong with a measured section, in sentences. Private to io/images.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "io/images/measure_section.hpp"
#include "io/images/pores.hpp"
#include "io/images/regions.hpp"

namespace havers::images {

/// Sentences for the user.
using Warnings = std::vector<std::string>;

/// Warns of a pixel size that is not known or too coarse. It is that of a file, for all its pages.
void warn_of_scale(const io::SectionOptions& options, Warnings& warnings);

/// What was found in an image.
struct Findings {
  const cv::Mat& whole;    ///< The image in grey.
  const cv::Mat& colours;  ///< How colourful it is; empty where it is grey.
  const PoreMap& map;
  const Regions& regions;
};

/// Adds to `section` the `doubts` there are already and its own (I17), which make it doubtful, then
/// warnings, which do not.
void add_doubts(const Findings& found, const io::SectionOptions& options, Warnings doubts,
                calib::SectionPorosity& section);

}  // namespace havers::images
