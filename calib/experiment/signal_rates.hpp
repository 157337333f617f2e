// A signal's rate of change on an even grid.
#pragma once

#include <vector>

#include "calib/experiment/clocks.hpp"

namespace havers::calib {

/// Rates between neighbouring points of a grid, clipped so that a break counts as an edge and not
/// as all there is.
struct SignalRates {
  double start = 0.0;         ///< Time in the middle of the first step. [s]
  double step = 0.0;          ///< [s]
  std::vector<double> value;  ///< [unit / s]

  /// Between the steps linear; 0 outside.
  [[nodiscard]] double at(double time) const;
};

/// The signal's value at a time, linear between rows; the nearest outside. Unit of the signal.
double value_at(const Signal& signal, double time);

/// The step at which the signal rises well above its noise, not below its sampling. [s]
double telling_step(const Signal& signal);

/// Rates over steps [s] from the signal's first time on, clipped at twice that of its loading
/// (X17).
SignalRates rates_of(const Signal& signal, double step);

}  // namespace havers::calib
