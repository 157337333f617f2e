// The model over many scenes: what is asked, and what came out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "calib/sweep/finding.hpp"
#include "calib/sweep/law.hpp"
#include "calib/sweep/measure.hpp"
#include "calib/sweep/plan.hpp"
#include "calib/sweep/strength_law.hpp"

namespace havers::calib {

/// A figure of the page: a measure, or the stress-strain curves of the first seeds.
struct SweepFigure {
  std::string caption;
  std::string x;       ///< Key along the axis; empty: stress against strain.
  std::string series;  ///< Key that tells the lines apart; empty: one line.
  std::string per;     ///< Key with a panel for each value; empty: one panel.
  Measure response = Measure::strength;
};

/// A sweep, as its user describes it.
struct Sweep {
  std::string name;
  std::string text;  ///< What it is for, in words.
  SweepPlan plan;
  std::vector<SweepPoint> points;  ///< Of the first level.
  int levels = 1;  ///< 2: the strengths of every point become the thresholds of a scale above.
  bool patterns = false;  ///< Whether to look at the joints that broke; such runs are not kept.
  std::vector<LawRequest> laws;
  std::vector<FindingRequest> findings;
  std::vector<SweepFigure> figures;
};

/// What a sweep answers.
struct SweepResult {
  std::vector<SweepPoint> points;       ///< Those of the second level follow those of the first.
  std::vector<SweepRun> runs;           ///< In the order of points and seeds.
  std::vector<PointSummary> summaries;  ///< One for each point.
  std::vector<StrengthLaw> strengths;   ///< One for each point; none where a run did not break.
  std::vector<Law> laws;
  std::vector<Finding> findings;
  long simulated = 0, failed = 0;
  std::string most_failed_because;    ///< Empty where none failed.
  std::string most_reserved_because;  ///< Empty where every run is trusted without more.
  bool cancelled = false;

  /// At most a twentieth of the runs failed or did not break; their points say which.
  [[nodiscard]] bool trusted() const;
  /// The measures that any point tells.
  [[nodiscard]] std::vector<Measure> known() const;
};

/// Of several sweeps together.
struct SweepTotals {
  bool trusted = true;
  long runs = 0, failed = 0, unbroken = 0, reserved = 0;
  long simulated = 0;  ///< Not in the store: what the time was spent on.

  void add(const SweepResult& result);
};

/// Called with the finished and all runs of a sweep; returning false stops it.
using SweepObserver = std::function<bool(std::size_t done, std::size_t all)>;

/// Runs a sweep. Stopped and started again with the same store, it goes on where it was.
/// `stop_asked` is asked inside the simulations, by all threads; true ends them, and the sweep as
/// `cancelled`.
/// Precondition: the plan has no problems and no scene has any.
SweepResult run_sweep(const Sweep& sweep, EvaluationStore* store, int threads,
                      const SweepObserver& observer, const sim::StopAsked& stop_asked = {});

/// The scene of the scale above (W7): what held a whole assembly is now one of its joints.
sim::Scene scale_above(const sim::Scene& scene, const PointSummary& below);

}  // namespace havers::calib
