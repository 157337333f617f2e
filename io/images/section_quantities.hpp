// What is stated of a section, from its bone and pores. Private to io/images.
#pragma once

#include "io/images/measure_section.hpp"
#include "io/images/pores.hpp"

namespace havers::images {

/// Porosity, counts, areas, zones and spread between windows of a pore map. Where the pixel size is
/// unknown, what needs it is NaN.
calib::SectionPorosity section_quantities(const PoreMap& map, bool outlined,
                                          const io::SectionOptions& options);

}  // namespace havers::images
