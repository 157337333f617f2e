// Two recorders with a clock each: what one clock shows when the other shows a time.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace havers::calib {

/// A recorded signal. Times [s] do not decrease.
struct Signal {
  std::span<const double> time, value;
};

/// A signal of the figure, in parts of the range of the record it is compared with.
struct ClockTrace {
  std::vector<double> time;  ///< [s]
  std::vector<double> part;  ///< [-]
};

/// Machine's time = offset + rate · (logger's time − reference) (X17).
struct ClockFit {
  double reference = 0.0;  ///< Logger's time, at the break or in the middle of what both saw. [s]
  double offset = 0.0;     ///< Machine's time at it. [s]
  double offset_standard_error = 0.0;  ///< [s]
  double rate = 1.0;                   ///< Of the machine's clock by the logger's. [-]
  double rate_standard_error = 0.0;    ///< 0 where it was not fitted. [-]
  bool rate_fitted = false;            ///< False: the signals do not tell it, and it is taken as 1.
  double correlation = 0.0;            ///< Of the rates at the fit. [-]
  ClockTrace machine, logger;  ///< As recorded, each on its own clock and in parts of its range.
  ClockTrace aligned;   ///< The machine's signal that the logger's lets expect, machine's clock.
  ClockTrace residual;  ///< Aligned less machine's, up to the break.
  std::string problem;  ///< Not empty: the signals do not determine the clocks.

  [[nodiscard]] double logger_time(double machine_time) const {
    return reference + (machine_time - offset) / rate;
  }
};

/// Estimates offset and rate from signals that rise and fall together: loading, holds, the break.
ClockFit fit_clocks(const Signal& machine, const Signal& logger);

}  // namespace havers::calib
