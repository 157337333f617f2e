// The joint law: Signorini-Coulomb with the cone's tip moved by the cohesion. Section 3 of
// sim/README.md.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/scene.hpp"

namespace havers::sim {

/// A vector in a joint's frame: (normal, tangential).
using Local = Eigen::Vector2d;

/// That of one joint among those of all.
inline Local of_joint(const Eigen::VectorXd& all, std::size_t joint) {
  return all.segment<2>(static_cast<Eigen::Index>(2 * joint));
}

/// |R_T| ≤ μ (R_N + c): (M5) with c = f_N and μ = f_T/f_N while intact, (M7) with c = 0 and μ = μ_f
/// when broken.
struct JointLaw {
  double cohesion = 0.0;  ///< c. [N/m]
  double friction = 0.0;  ///< μ. [-]
};

/// Less friction counts as this: a cone without width leaves to rounding which way its joint
/// slides.
constexpr double least_friction = 1e-3;

/// The law of (M5) and that of (M7). Neither is narrower than `least_friction`: a shear threshold
/// counts as that part of the one in tension at least.
JointLaw intact_law(const Threshold& threshold);
JointLaw broken_law(double friction);

/// How far inside the cone a reaction is, μ (R_N + c) − |R_T|; negative outside. [N/m]
inline double cone_margin(const Local& reaction, const JointLaw& law) {
  return law.friction * (reaction.x() + law.cohesion) - std::abs(reaction.y());
}

/// Strain at which a reaction that grows as `modulus` · r · strain meets the cone (M5),
///
///   ε = μ c / (E (|r_T| − μ r_N)) ;
///
/// infinite where it never does, or where what tells is no more than the `noise` of r. [-]
inline double strain_at_cone(const Local& reaction, const JointLaw& law, double modulus,
                             double noise) {
  const double denominator = std::abs(reaction.y()) - law.friction * reaction.x();
  if (denominator <= noise * std::max(1.0, law.friction))
    return std::numeric_limits<double>::infinity();
  return law.cohesion * law.friction / (modulus * denominator);
}

/// Nearest point of the shifted cone.
inline Local project_on_cone(const Local& reaction, const JointLaw& law) {
  const double mu = law.friction, n = reaction.x() + law.cohesion, t = std::abs(reaction.y());
  if (t <= mu * n) return reaction;               // inside the cone
  if (mu * t <= -n) return {-law.cohesion, 0.0};  // inside the polar cone: the tip
  const double normal = (n + mu * t) / (1.0 + mu * mu);
  return {normal - law.cohesion, std::copysign(mu * normal, reaction.y())};
}

/// Natural-map residual of the law; zero exactly where it holds (M11).
///
///   r − P( r − k (u + μ |u_t| n) )
///
/// @param reaction   r. [N/m]
/// @param gap        u: gap along the normal and slip since the last step, or the start in the
/// limit. [m]
/// @param stiffness  k > 0, makes the two comparable: the force that a wrong gap would cause.
/// [N/m²]
inline Local law_residual(const Local& reaction, const Local& gap, const JointLaw& law,
                          double stiffness) {
  assert(stiffness > 0.0);
  const Local lifted(gap.x() + law.friction * std::abs(gap.y()), gap.y());
  return reaction - project_on_cone(reaction - stiffness * lifted, law);
}

}  // namespace havers::sim
