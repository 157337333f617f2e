// The numbers by which a simulated and a measured curve are compared.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>

namespace havers::calib {

/// Terms of the objective (F4). Each is 0 or a logarithm, so that differences compare. The last
/// four are independent of the scales of stress and strain, so that curves that end at different
/// strains are compared without extending either.
enum Landmark : Eigen::Index {
  modulus,    ///< log E.
  strength,   ///< log σ_max.
  linearity,  ///< log(σ_max / (E ε_max)); with the two before it, the failure strain.
  pre_peak,   ///< Height of the curve above its chord, mean along its normalised arc length.
  energy,     ///< log(2W / (σ_max ε_max)), W the energy to the peak.
  post_peak,  ///< Strain in which the stress falls to half, over ε_max.
};
inline constexpr Eigen::Index landmark_count = 6;
/// Part of the strength to which the stress falls in the post-peak drop. [-]
inline constexpr double fallen_part = 0.5;
using Landmarks = Eigen::Array<double, landmark_count, 1>;

/// "modulus", "strength", "failure strain", "pre-peak curve", "energy", "post-peak drop".
std::string_view name_of(Landmark landmark);

/// Landmarks of the curve alone: pre_peak, energy and post_peak; the others are 0. All 0 where
/// there is no curve. Strain [-] and stress [Pa] row by row, the peak being the largest stress. The
/// end of a curve counts as its fall.
Landmarks shape_of(std::span<const double> strain, std::span<const double> stress);

}  // namespace havers::calib
