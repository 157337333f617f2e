// Offset and rate between two clocks, from a first guess to the least squares of the signals.
#pragma once

#include <Eigen/Core>

#include "calib/experiment/clocks.hpp"

namespace havers::calib {

/// (X17) Machine's signal = cubic of the logger's at the logger's time, so that no straight
/// material is assumed; by Gauss and Newton over the cubic, the offset and the rate. Rows at the
/// break, where a sampling interval decides, do not count.
class ClockRefinement {
 public:
  /// How many unknowns are free.
  enum Free { cubic = 4, with_offset = 5, with_rate = 6 };

  /// `step` is the time over which the logger's slope is taken. [s]
  ClockRefinement(const Signal& machine, const Signal& logger, double step);

  /// Improves `fit` and sets its standard errors.
  void refine(ClockFit& fit, Free free);

  /// The records in parts of their ranges and what the cubic leaves of the machine's, for the
  /// figure. Offset and rate are kept.
  void draw(ClockFit& fit);

 private:
  using Unknowns = Eigen::Matrix<double, with_rate, 1>;

  [[nodiscard]] double gauge(double at) const;
  [[nodiscard]] double machine_part(double value) const;
  [[nodiscard]] bool both_saw(double at) const;
  [[nodiscard]] bool breaks(double time, double at) const;
  [[nodiscard]] double of_gauge(double g) const;
  double row_of(const ClockFit& fit, std::size_t i, Unknowns& row) const;
  void take_step(ClockFit& fit, Free free);

  Signal machine_, logger_;
  double step_;
  double machine_low_, machine_range_, logger_low_, logger_range_;
  Eigen::Vector4d coefficients_ = Eigen::Vector4d::Zero();
};

}  // namespace havers::calib
