// Whether 95 % intervals hold the truth in 95 % of studies.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "calib/synthetic/known_study.hpp"
#include "sim/stop_asked.hpp"

namespace havers::calib {

/// One parameter of one known study, as the default chain fits it.
struct CoverageRow {
  std::string design;
  int study = 0;
  std::string parameter;
  double truth = 0.0;  ///< In the parameter's unit, as what follows.
  double value = 0.0;
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< NaN where not informed.
  double upper = std::numeric_limits<double>::quiet_NaN();
  bool informed = false;  ///< An interval is given.
  bool inside = false;    ///< It holds the truth.
};

/// Rows of one design and parameter.
struct CoverageSummary {
  std::string design, parameter;
  int studies = 0, informed = 0;
  Rate inside;                       ///< Of those informed.
  std::array<double, 3> half_width;  ///< ½ log(upper/lower): 10, 50 and 90 %; NaN if none. [-]

  [[nodiscard]] int held() const;  ///< Intervals that hold the truth.
};

/// What the share of intervals that hold the truth says of their width, as far as chance lets it be
/// told.
enum class IntervalWidth {
  as_promised,
  too_wide,
  too_narrow,
  perhaps_too_wide,  ///< The share's own interval leaves out 95 %, which may be chance among many.
  perhaps_too_narrow,
  too_few,  ///< Neither all nor none would be beside 95 % by more than chance, or the share's own
            ///< interval reaches below 85 %, three times as many misses as promised.
};
/// For tables: "as promised", "too few to tell".
std::string to_string(IntervalWidth width);

/// All intervals, and what they come to.
struct Coverage {
  std::vector<CoverageRow> rows;
  std::vector<CoverageSummary> summaries;
  bool complete = true;  ///< Every study was fitted.

  /// Beside 95 % by more than chance: by the binomial law, at 0.05/m for m shares (Bonferroni). Of
  /// intervals that are as promised one bench in twenty or fewer calls any something else.
  [[nodiscard]] IntervalWidth width_of(const CoverageSummary& summary) const;
  /// None are too narrow.
  [[nodiscard]] bool holds() const;
};

/// Specimens at 0° and 90°, and at 0°, 45° and 90°; alike, and 10 % apart.
std::vector<Design> coverage_designs();

/// Fits `studies` known studies of each design. `go_on` is asked before every fit, false ends;
/// `stop_asked` inside the simulations, true ends, without the rows of the study that is stopped.
Coverage measure_coverage(const std::vector<Design>& designs, int studies, int threads,
                          const std::function<bool()>& go_on,
                          const sim::StopAsked& stop_asked = {});

}  // namespace havers::calib
