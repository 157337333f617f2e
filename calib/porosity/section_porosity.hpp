// The porosity of one section, as measured on an image. Filled by io/images.
#pragma once

#include <string>
#include <vector>

namespace havers::calib {

/// Names follow bone histomorphometry: porosity is void area over bone area (Ct.Po).
struct SectionPorosity {
  std::string file;
  double pixel_size = 0.0;               ///< [m]
  std::string method;                    ///< How the threshold was found.
  double threshold = 0.0;                ///< On the flat-fielded grey scale, 0 pore to 1 bone. [-]
  double porosity = 0.0;                 ///< p. [-]
  double porosity_standard_error = 0.0;  ///< [-]
  int pore_count = 0;
  double pore_area = 0.0;        ///< Sum over pores. [m²]
  double bone_area = 0.0;        ///< Inside the mask, pores included. [m²]
  double pore_area_ratio = 0.0;  ///< a* = E[a²]/E[a] over pores (K2). [m²]
  double window_sd = 0.0;  ///< SD of local porosity in windows of one fibre; NaN: unknown. [-]
  double window_sd_standard_error = 0.0;  ///< [-]
  std::vector<std::string> warnings;
};

}  // namespace havers::calib
