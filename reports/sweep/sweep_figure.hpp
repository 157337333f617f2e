// The figures of a sweep.
#pragma once

#include <string>
#include <vector>

#include "calib/sweep/sweep.hpp"
#include "reports/figures/gnuplot.hpp"

namespace havers::reports {

/// A figure for each panel, in the order of its value.
struct SweepPanel {
  std::string at;  ///< "θ = 45°"; empty for the only one.
  Figure figure;
};
/// The panels of one figure that a sweep asks for: means with intervals against a key, or
/// stress-strain curves if it names no key for x. A panel without data has no commands. The ids of
/// all panels begin with `id`.
std::vector<SweepPanel> sweep_figures(const calib::Sweep& sweep, const calib::SweepResult& result,
                                      const calib::SweepFigure& wanted, const std::string& id);

}  // namespace havers::reports
