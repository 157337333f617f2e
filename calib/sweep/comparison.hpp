// The comparisons behind a finding: a value with an interval, each.
#pragma once

#include "calib/sweep/finding.hpp"

namespace havers::calib {

/// One number that a claim is judged by: a relative difference (W3), a coefficient of variation
/// (W4), a distance from a line over the mean (W5), or a mean in its SI unit.
struct Comparison {
  std::vector<ComparedKey> compared{};
  /// The interval is NaN where a point has fewer than two runs.
  double value = 0.0, low = 0.0, high = 0.0;
  bool step = false;                  ///< Between neighbours, beside a claim about the ends.
  std::vector<std::size_t> points{};  ///< That it compares, or the one that it is of.
};

/// What a claim is judged by. The caller owns all of it and must keep it alive.
struct Evidence {
  const FindingRequest& request;
  const SweepPlan& plan;
  const std::vector<SweepPoint>& points;
  const std::vector<SweepRun>& runs;
};

/// All comparisons of a claim among a group of points; their intervals hold together with 95 %
/// (Bonferroni).
std::vector<Comparison> comparisons_of(const Evidence& evidence, const PointGroup& group);

/// Whether a claim finds nothing to compare among a group of points, whatever the runs say.
bool compares_nothing(const FindingRequest& request, const SweepPlan& plan,
                      const std::vector<SweepPoint>& points, const PointGroup& group);

}  // namespace havers::calib
