// Every point that a calibration evaluates, and the best of them.
#pragma once

#include <string>
#include <vector>

#include "calib/fit/calibration.hpp"
#include "calib/fit/fit_problem.hpp"
#include "sim/stopwatch.hpp"

namespace havers::calib {

/// Evaluates points for the searches, keeps the best, tells the observer, and ends the searches
/// when the budget is spent or the user has had enough. An answer is always taken from here, never
/// from an optimiser.
///
/// The budget counts points that need new simulations (F3), as many as all replicates of all
/// fitted specimens: those with fewer replicates count in proportion. A simulation found in the
/// store counts like one that is run, so that a fit resumed takes the same path.
class Trail {
 public:
  /// All three have to outlive it.
  Trail(const FitProblem& problem, SimulationBatch& batch, const CalibrationObserver& observer)
      : problem_(problem),
        batch_(batch),
        observer_(observer),
        replicates_(all_replicates(problem.study.calibrate)) {}

  /// Scored evaluations in the order of the points, one batch; failed ones once stopped.
  /// Precondition: restart() has given weights.
  std::vector<Evaluation> evaluate(const std::vector<Point>& points);
  Evaluation evaluate(const Point& point) { return evaluate(std::vector{point}).front(); }

  /// New weights: the best so far is forgotten, and begins again with the point given.
  void restart(Weights weights, Evaluation from);

  /// Names the stage of the search, for the observer.
  void enter(std::string stage) { stage_ = std::move(stage); }
  /// For the points that follow; the best point keeps the replicates that it has.
  void set_replicates(int replicates) { replicates_ = replicates; }
  void lift_budget() { budget_lifted_ = true; }  ///< For the last look at the answer.

  [[nodiscard]] const FitProblem& problem() const { return problem_; }
  [[nodiscard]] SimulationBatch& batch() { return batch_; }
  [[nodiscard]] const Weights& weights() const { return weights_; }
  /// The lowest cost since restart(), by the weights that it gave; where they are equal the
  /// earliest.
  [[nodiscard]] const Evaluation& best() const { return best_; }
  [[nodiscard]] int replicates() const { return replicates_; }
  [[nodiscard]] int points() const { return points_; }  ///< Evaluated, failed ones too.
  /// Since the search began. [s]
  [[nodiscard]] double wall_seconds() const { return stopwatch_.wall_seconds(); }
  /// By the observer, or by the simulator inside a simulation.
  [[nodiscard]] bool cancelled() const { return cancelled_ || batch_.stopped(); }
  [[nodiscard]] bool budget_spent() const { return budget_spent_; }
  [[nodiscard]] bool stopped() const { return cancelled() || budget_spent_; }

 private:
  /// Counts a point, keeps it if it is the best, and tells the observer.
  void note(const Evaluation& evaluation);

  const FitProblem& problem_;
  SimulationBatch& batch_;
  const CalibrationObserver& observer_;
  Weights weights_;
  Evaluation best_;
  std::string stage_;
  int replicates_ = 1;
  int points_ = 0;
  sim::Stopwatch stopwatch_;
  bool cancelled_ = false, budget_spent_ = false, budget_lifted_ = false;
};

}  // namespace havers::calib
