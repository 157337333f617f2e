// Error against run time: one scene by several solvers, tolerances, steps and meshes, over a few
// seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/bench/bench_setting.hpp"
#include "sim/bench/watched_run.hpp"

namespace havers::sim {

/// Median and extremes over the seeds for which the number is known.
struct BenchSpread {
  double median = 0.0, low = 0.0, high = 0.0;
  int of = 0;  ///< How many these are.
};

/// Relative errors against the reference of the same seed; NaN where a run did not get there. [-]
struct BenchErrors {
  BenchSpread bonded_forces;  ///< Of all joint forces before the first break.
  BenchSpread forces;         ///< After the last break of which runs agree: joint and order.
  BenchSpread strength;       ///< The largest stress, waves included.
  BenchSpread strength_without_ringing;  ///< As fits take it.
  BenchSpread failure_strain;
  BenchSpread curve;  ///< Root mean square of the stress, relative to the strength, up to failure.
};

struct BenchRow {
  BenchSetting setting;       ///< It leaps where one of its runs did.
  int runs = 0, trusted = 0;  ///< Seeds, and those whose run is to be trusted.
  int out_of_time = 0;        ///< 1 where the last was stopped at the time limit, and others left.
  BenchSpread reached;        ///< Strain of the last row. [-]
  BenchSpread stopped_at;     ///< The same, of the one that was stopped at the time limit. [-]
  BenchErrors errors;
  BenchSpread wall, cpu;  ///< [s]
  BenchSpread steps, iterations;
  BenchSpread same_breaks;  ///< Joints broken in the reference's order before they part.
};

/// The setting of least CPU time whose error is below a target for every seed.
struct CheapestSetting {
  std::string quantity;                 ///< "strength", "failure strain", ...
  double target = 0.0;                  ///< [-]
  double reference_error = 0.0;         ///< Of this quantity; above the target none is named. [-]
  std::optional<std::size_t> row = {};  ///< None: no setting reaches it.
};

/// What leaving out changes and spares, from runs that differ in nothing else.
struct Omissions {
  BenchSetting setting;    ///< That leaves out.
  double change = 0.0;     ///< Largest of all errors against the runs that leave out nothing. [-]
  double cpu_ratio = 0.0;  ///< Median CPU time of those, relative to that of the others. [-]
  /// Where those were stopped at the time limit: until there joint forces are compared, and the CPU
  /// times are those of a step. [-]
  std::optional<double> until_strain = {};
};

/// In a sentence.
std::string explain(const Omissions& omissions);

struct WorkPrecision {
  bool complete = false;  ///< false: stopped before the last run.
  BenchSetting reference;
  std::string reference_ground;  ///< What the errors are measured against, in a sentence.
  /// What the reference itself may err by: its change from a step twice as long, as errors are of
  /// first order in h. Zero in the limit; that of the bonded forces also where `closed_form`.
  BenchErrors reference_errors;
  double bonded_strain = 0.0;  ///< Where forces before any seed's first break are compared. [-]
  /// Whether those are compared with their closed form instead of with the reference's.
  bool closed_form = false;
  double time_limit = 0.0;  ///< Wall time of a run, but for the reference's. [s]
  std::vector<std::uint64_t> seeds;
  std::vector<BenchRow> rows;  ///< The first is the reference; one, in time, has twice its step.
  std::vector<CheapestSetting> cheapest;
  /// None where a run of either kind is not to be trusted, or was stopped before it had forces.
  std::optional<Omissions> omissions;
};

struct BenchOptions {
  int seeds = 3;             ///< Runs of each setting: the scene's seed and those that follow it.
  double time_limit = 20.0;  ///< Wall time of one run. [s]
};

/// Told what comes next; returning false ends the comparison with what there is.
using BenchObserver = std::function<bool(const std::string& next)>;

/// Precondition: scene.problems() is empty.
WorkPrecision compare_settings(const Scene& scene, const BenchOptions& options,
                               const BenchObserver& observer = {});

/// For every quantity and target, from the rows and what the reference may err by.
std::vector<CheapestSetting> cheapest_settings(const WorkPrecision& study);

/// Whether all runs that errors are measured against are to be trusted.
inline bool reference_is_trusted(const WorkPrecision& study) {
  return !study.rows.empty() && study.rows.front().trusted == study.rows.front().runs;
}

/// The cheapest row whose failure strain is right to 0.1 % for every seed; none where the reference
/// alone is.
std::optional<std::size_t> cheapest_for_failure(const WorkPrecision& study);

/// The outcome in a sentence.
std::string summary(const WorkPrecision& study);

}  // namespace havers::sim
