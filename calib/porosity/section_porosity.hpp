// The porosity of one section, as measured on an image. Filled by io/images.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace havers::calib {

/// Pores of one size, by the diameter of the circle of their area.
struct PoreClass {
  std::string name;
  int count = 0;
  double area = 0.0;  ///< Sum over its pores. [m²]
};

/// Part of a section.
struct Zone {
  std::string name;
  double porosity = 0.0;   ///< [-]
  double bone_area = 0.0;  ///< Pores included. [m²]
};

/// Names follow bone histomorphometry [Dempster 2013]; each field says which it is.
struct SectionPorosity {
  std::string file;
  double pixel_size = 0.0;               ///< [m]
  std::string method;                    ///< How the threshold was found.
  double threshold = 0.0;                ///< Deeper is pore; depth is 0 in bone, 1 in pores. [-]
  double porosity = 0.0;                 ///< p, Ct.Po: pore area over bone area. [-]
  double porosity_standard_error = 0.0;  ///< [-]
  double porosity_by_grey = 0.0;         ///< Cross-check without a threshold. [-]
  int pore_count = 0;                    ///< Po.N.
  double pore_density = 0.0;             ///< Po.Dn, pores per bone area. [1/m²]
  double pore_area = 0.0;                ///< Sum over pores. [m²]
  double bone_area = 0.0;                ///< Ct.Ar: inside the mask, pores included. [m²]
  double total_area = 0.0;               ///< Tt.Ar: inside the outer outline. [m²]
  double marrow_area = 0.0;              ///< Ma.Ar. [m²]
  double mean_pore_area = 0.0;           ///< Po.Ar; NaN without pores. [m²]
  double pore_area_sd = 0.0;             ///< [m²]
  double mean_pore_diameter =
      0.0;                        ///< Po.Dm, of the circle of a pore's area; NaN without pores. [m]
  double pore_diameter_sd = 0.0;  ///< [m]
  double pore_area_ratio = 0.0;   ///< a* = E[a²]/E[a] over pores (K2). [m²]
  double window_area = 0.0;       ///< A of the windows below. [m²]
  double window_sd = 0.0;  ///< SD of local porosity in windows of one fibre; NaN: unknown. [-]
  double window_sd_standard_error = 0.0;  ///< [-]
  int crack_count = 0;
  double crack_area = 0.0;  ///< Not in the pore area. [m²]
  int speck_count = 0;      ///< Objects too small to be told from noise, left out.
  std::vector<PoreClass> classes;
  std::vector<Zone> zones;
  double density = std::numeric_limits<double>::quiet_NaN();  ///< Of solid bone, by its grey
                                                              ///< level; NaN: unknown. [kg/m³]
  double density_residual = 0.0;  ///< RMS of the references about the line; NaN of two. [kg/m³]
  std::vector<std::string> warnings;
  bool doubtful = false;  ///< Whether a warning doubts the porosity itself.
};

/// Diameter of the pore that a point in pores lies in on average, as a circle of a*. [m]
inline double usual_pore_diameter(const SectionPorosity& section) {
  return std::sqrt(section.pore_area_ratio * 4.0 / std::numbers::pi);
}

/// Whether pores are as wide as canals in bone are, or of unknown size; else the pixel size is
/// mostly wrong.
inline bool pores_may_be_canals(const SectionPorosity& section) {
  constexpr double narrowest = 10e-6, widest = 500e-6;  // [m]
  const double diameter = usual_pore_diameter(section);
  return !(diameter > 0.0) || (diameter >= narrowest && diameter <= widest);
}

/// How many of a section's bone pixels are how deep; the depth is 0 in bone and 1 in pores.
struct DepthHistogram {
  std::vector<double> depth;  ///< Middle of each bin. [-]
  std::vector<double> share;  ///< Of the bone's pixels, one a bin. [-]
  double threshold = 0.0;     ///< Deeper is pore. [-]
};

}  // namespace havers::calib
