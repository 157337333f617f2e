#include "sim/joint/cohesive_cone.hpp"

#include <algorithm>
#include <cassert>

namespace havers::sim {

JointLaw intact_law(const Threshold& threshold) {
  // Without a tensile threshold a joint is missing, and has the law of a broken one.
  assert(threshold.normal > 0.0);
  return {threshold.normal, std::max(threshold.tangent / threshold.normal, least_friction)};
}

JointLaw broken_law(double friction) {
  return {0.0, std::max(friction, least_friction)};
}

}  // namespace havers::sim
