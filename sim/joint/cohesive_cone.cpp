#include "sim/joint/cohesive_cone.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace havers::sim {

JointLaw intact_law(const Threshold& threshold) {
  assert(threshold.normal > 0.0);
  return {threshold.normal, std::max(threshold.tangent / threshold.normal, least_friction)};
}

JointLaw broken_law(double friction) {
  return {0.0, std::max(friction, least_friction)};
}

double cone_margin(const Local& reaction, const JointLaw& law) {
  return law.friction * (reaction.x() + law.cohesion) - std::abs(reaction.y());
}

Local project_on_cone(const Local& reaction, const JointLaw& law) {
  const double mu = law.friction, n = reaction.x() + law.cohesion, t = std::abs(reaction.y());
  if (t <= mu * n) return reaction;               // inside the cone
  if (mu * t <= -n) return {-law.cohesion, 0.0};  // inside the polar cone: the tip
  const double normal = (n + mu * t) / (1.0 + mu * mu);
  return {normal - law.cohesion, std::copysign(mu * normal, reaction.y())};
}

Local law_residual(const Local& reaction, const Local& gap, const JointLaw& law, double stiffness) {
  assert(stiffness > 0.0);
  const Local lifted(gap.x() + law.friction * std::abs(gap.y()), gap.y());
  return reaction - project_on_cone(reaction - stiffness * lifted, law);
}

}  // namespace havers::sim
