// A claim about the model, judged by the runs of a sweep alone (W3 to W5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/sweep/measure.hpp"

namespace havers::calib {

/// What a claim says of a response; `margin` is what counts as a difference.
enum class FindingTest {
  same,     ///< Whatever the key, within the margin of one another.
  matters,  ///< The key makes a difference beyond the margin.
  rises,    ///< From the key's smallest value to its largest, and nowhere falls in between.
  falls,
  linear,  ///< Linear in the keys, within the margin of the mean.
  steady,  ///< The coefficient of variation over the seeds is below the margin.
  above,   ///< The mean is above the margin.
  below,
};

/// Whether a mean itself is judged, `above` or `below`: value and margin are in its SI unit, else
/// relative.
bool judges_means(FindingTest test);

/// A claim and how it is to be judged, as a sweep's file states it.
struct FindingRequest {
  std::string id, claim;
  FindingTest test = FindingTest::same;
  Measure response = Measure::strength;
  std::vector<std::string> keys;  ///< What is compared; `linear` takes several.
  std::string per;                ///< Key with a judgement for each of its values; empty: one.
  double margin = 0.05;           ///< Relative, or in SI units where `judges_means`.
  std::string if_agrees, if_disagrees, if_undecided;  ///< What it means, in words.
};

/// Undecided: an interval lies across an end of what was asked, or is not known.
enum class FindingOutcome { agrees, disagrees, undecided };

std::string to_string(FindingOutcome outcome);

/// A key of what is compared, its value, and the one it is compared with; empty: with none.
struct ComparedKey {
  std::string name, value, against;
};

/// "joints.ratio = 3.0 against 1.0, joints.scatter = 0.2".
std::string to_string(const std::vector<ComparedKey>& keys);

/// A claim judged for one value of `per`; undecided where a run did not break. Value and interval
/// are those of the comparison that speaks most against the claim; the intervals of all comparisons
/// hold together with 95 %.
struct Finding {
  std::string id, claim;
  std::string per, at;  ///< A key and its value; empty: the finding is of all points.
  FindingTest test = FindingTest::same;
  Measure response = Measure::strength;
  FindingOutcome outcome = FindingOutcome::undecided;
  double value = 0.0, low = 0.0, high = 0.0;  ///< NaN where nothing could be compared.
  double asked_low = 0.0, asked_high = 0.0;  ///< What agrees lies between; of `matters`, disagrees.
  std::vector<ComparedKey> compared;
  std::string ground;   ///< The test, in words.
  std::string meaning;  ///< The words given for this outcome.
  int comparisons = 0;
  long runs = 0;                                 ///< That the judgement rests on.
  double inertia_low = 0.0, inertia_high = 0.0;  ///< I (M12) of its points; NaN: none has one. [-]
};

/// 1 where two digits of the interval's width, in units of `scale`, would hide that an end of it
/// lies beyond what was asked; else 0.
int extra_digits(const Finding& finding, double scale);

/// The first group of points, by `per`, in which a claim finds nothing to compare whatever the runs
/// say.
std::optional<PointGroup> group_without_comparison(const FindingRequest& request,
                                                   const SweepPlan& plan,
                                                   const std::vector<SweepPoint>& points);

/// The claim, once for each value of `per`.
std::vector<Finding> judge(const FindingRequest& request, const SweepPlan& plan,
                           const std::vector<SweepPoint>& points,
                           const std::vector<SweepRun>& runs);

}  // namespace havers::calib
