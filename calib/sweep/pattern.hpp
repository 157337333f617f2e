// The joints that broke, as one picture in numbers.
#pragma once

#include "sim/assembly/assembly.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {

/// Broken joints are segments; those that share an end make a chain (W8).
struct Pattern {
  int head_tail = 0, flank = 0;  ///< Broken joints.
  double span = 0.0;             ///< Height of the highest chain over that of the specimen. [-]
  double linked = 0.0;  ///< Part of the broken head-tail joints that end where a broken flank does;
                        ///< NaN when none broke. [-]
};

/// Cost O(n log n) for n broken joints. Missing joints make chains longer, but do not count as
/// broken. Precondition: one outcome for each joint of the assembly, in its order.
Pattern pattern_of(const sim::Assembly& assembly, const std::vector<sim::JointOutcome>& joints);

}  // namespace havers::calib
