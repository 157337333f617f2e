// Offset and rate between two clocks, from a first guess to the least squares of the signals.
#pragma once

#include <optional>

#include "calib/experiment/clocks.hpp"

namespace havers::calib {

/// The break in both records.
struct CommonBreak {
  double machine_time = 0.0, logger_time = 0.0;  ///< Each on its own clock. [s]
  double standard_error = 0.0;                   ///< Of their difference. [s]
};

/// What the clocks are told from.
struct ClockEvidence {
  Signal machine, logger;  ///< Up to the break, where both saw one.
  std::optional<CommonBreak> broke;
  double step = 0.0;  ///< Over which the logger's slope is taken. [s]
  double lowest =
      0.0;  ///< Rows where either signal is below this part of its range say nothing. [-]
};

/// (X17) Machine's signal = spline of the logger's at the logger's time, so that no straight
/// material is assumed; by Gauss and Newton over the spline, the offset and the rate, which is kept
/// at 1 where its error would exceed a hundredth. `fit` is the first guess, a step off at most.
ClockFit refine_clocks(const ClockEvidence& evidence, ClockFit fit);

/// Sets the curves of the figure: the whole records, and what the spline leaves of the machine's.
void draw_clocks(ClockEvidence evidence, const Signal& machine, const Signal& logger,
                 ClockFit& fit);

}  // namespace havers::calib
