// Density of solid bone from grey levels and materials of known density. Private to io/images.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "io/images/measure_section.hpp"
#include "io/images/pores.hpp"

namespace havers::images {

/// Fits density as a line of grey level through the references and reads it at the mean of solid
/// bone (I13). `bone_grey` is the part of `whole` that `map` covers.
/// Both are NaN without references, and where no bone is solid. @throws io::InputError when the
/// references do not make a line.
void add_density(const cv::Mat& whole, const cv::Mat& bone_grey, const PoreMap& map,
                 const std::vector<io::DensityReference>& references,
                 calib::SectionPorosity& section);

}  // namespace havers::images
