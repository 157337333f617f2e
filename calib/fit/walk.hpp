// Unknowns that were left out are not known: they may be anywhere in their bounds.
#pragma once

#include <vector>

#include "calib/fit/trail.hpp"
#include "calib/fit/uncertainty.hpp"

namespace havers::calib {

/// Points along an unknown that was left out, from bound to bound, the active ones refitted by
/// their slopes, each scored by its own likelihood (F22). The trail's best stays what it is. Points
/// that failed are not among them.
std::vector<Evaluation> walk_along(Trail& trail, Eigen::Index unknown, const Active& active,
                                   const Eigen::MatrixXd& jacobian);

/// Intervals that hold wherever the specimens allow the unknowns left out to be (F22).
void widen_intervals(const Evaluation& best, const std::vector<Evaluation>& elsewhere,
                     const Active& active, Uncertainty& uncertainty);

}  // namespace havers::calib
