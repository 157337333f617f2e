// From porosity to the scattering parameter. Equations (K1)... of calib/porosity/README.md.
#pragma once

#include <vector>

#include "calib/porosity/section_porosity.hpp"

namespace havers::calib {

/// How porosity becomes scatter: by its spread over windows (K3), by a straight line, or not at
/// all.
enum class ToScatter { window, linear, none };
/// How porosity acts on the modulus: not at all, or by a power of the solid share 1 − p (K4).
enum class ToModulus { none, power };

/// The laws of porosity, as a study's table [porosity] gives them. The numbers can be calibrated.
struct PorosityOptions {
  ToScatter to_scatter = ToScatter::window;
  ToModulus to_modulus = ToModulus::none;
  double strength_exponent = 1.0;  ///< n of local strength ∝ (1−p)^n. [-]
  double linear_offset = 0.0;      ///< d₀ of d = d₀ + k p. [-]
  double linear_slope = 1.0;       ///< k. [-]
  double modulus_exponent = 2.7;   ///< m of E = E₀ (1−p)^m. [-]
};

/// Whether a specimen, or what a study names of it, tells its scatter: its sections do, and with
/// `linear` a bare porosity.
bool tells_scatter(const auto& specimen, const PorosityOptions& options) {
  switch (options.to_scatter) {
    case ToScatter::window:
      return !specimen.sections.empty();
    case ToScatter::linear:
      return !specimen.sections.empty() || specimen.porosity;
    case ToScatter::none:
      return false;
  }
  return false;
}

/// Porosity and scatter of one specimen, from all of its sections.
struct SpecimenPorosity {
  double porosity = 0.0;                 ///< Mean over sections. [-]
  double porosity_standard_error = 0.0;  ///< [-]
  double window_sd = 0.0;  ///< Over the windows of all sections (K1); NaN: no section gives it. [-]
  double window_sd_standard_error = 0.0;  ///< [-]
  double pore_area_ratio = 0.0;           ///< a* over the pores of all sections (K2). [m²]
  double window_area = 0.0;               ///< A. [m²]
};

/// Mean and pooled spread over a specimen's sections, weighted by bone area (equally, where a
/// section has no pixel size). Precondition: at least one.
SpecimenPorosity pool_sections(const std::vector<SectionPorosity>& sections);

/// Whether pores are larger than a window (A < a*), so that they take joints away rather than
/// spread their thresholds (K5).
bool removes_joints(const SpecimenPorosity& porosity);

/// Fraction of joints that pores take away: p, or 0 where they spread thresholds. [-]
double missing_joints(const SpecimenPorosity& porosity);

/// d = √12 n SD/(1−p) (K3) with `window`, d₀ + k p with `linear`; held inside [0, 1.99]. With
/// `none`, or where the window SD is unknown, NaN. [-]
double scatter_of(const SpecimenPorosity& porosity, const PorosityOptions& options);

/// Standard error of `scatter_of`, from those of window SD and porosity. [-]
double scatter_standard_error(const SpecimenPorosity& porosity, const PorosityOptions& options);

/// Factor (1−p)^m on the modulus (K4); 1 with `none`. [-]
double modulus_factor(const SpecimenPorosity& porosity, const PorosityOptions& options);

}  // namespace havers::calib
