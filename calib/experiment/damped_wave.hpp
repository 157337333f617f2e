// A line that carries one damped wave: a fast test on a load cell that rings.
#pragma once

#include <optional>
#include <span>

#include "calib/experiment/robust_line.hpp"

namespace havers::calib {

/// y = intercept + slope x + a damped sine.
struct CarriedWave {
  Line line;               ///< With the error of its slope as points that err alike have it (X4).
  double periods = 0.0;    ///< Of the wave along all points.
  double amplitude = 0.0;  ///< At the first point. [unit of y]
};

/// The wave that the points carry (X24); none where no wave, a bend without waves, or a wave of
/// less than 0.8 periods explains them as well.
std::optional<CarriedWave> find_damped_wave(std::span<const double> x, std::span<const double> y);

}  // namespace havers::calib
