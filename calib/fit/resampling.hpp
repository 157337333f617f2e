// What the answer would be with other specimens: each left out in turn, and drawn anew.
#pragma once

#include <string>

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// How the active unknowns would move, in the scale of their search.
struct Resampling {
  /// Row f: without fitted specimen f. NaN: not determined then, or of that specimen alone.
  Eigen::MatrixXd left_out;
  /// 95 % bootstrap interval of the shift (F16); empty if missing. Of six specimens, too few to
  /// draw from, it holds the truth in 78 to 91 % of studies.
  Eigen::VectorXd lower, upper;
  std::string missing;  ///< Why there is no bootstrap interval.
};

/// By one step with the slopes at the answer (F16), so that nothing is simulated.
/// Precondition: !answer.slopes.failed.
Resampling resample(const FitProblem& problem, const Answer& answer);

}  // namespace havers::calib
