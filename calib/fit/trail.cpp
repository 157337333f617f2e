#include "calib/fit/trail.hpp"

#include <algorithm>
#include <utility>

namespace havers::calib {

std::vector<Evaluation> Trail::evaluate(const std::vector<Point>& points) {
  const auto& options = problem_.study.calibrate;
  // Simulations of one point of the budget; a point with fewer replicates spends only a part of
  // that.
  const auto whole_point =
      static_cast<long>(problem_.fitted.size()) * std::max(all_replicates(options), replicates_);
  budget_spent_ =
      budget_spent_ || (!budget_lifted_ && batch_.distinct() >= options.budget * whole_point);
  if (stopped()) return std::vector<Evaluation>(points.size());

  auto evaluations = predict(problem_, batch_, points, replicates_);
  // Of a point whose replicates were not all simulated nothing is known.
  if (batch_.stopped()) return std::vector<Evaluation>(points.size());
  for (auto& evaluation : evaluations) {
    score(problem_, weights_, evaluation);
    note(evaluation);
  }
  return evaluations;
}

void Trail::restart(Weights weights, Evaluation from) {
  // Costs by other weights do not compare: the former best is forgotten.
  weights_ = std::move(weights);
  score(problem_, weights_, from);
  best_ = std::move(from);
}

void Trail::note(const Evaluation& evaluation) {
  ++points_;
  if (evaluation.cost < best_.cost) best_ = evaluation;
  // An observer that has stopped the fit is not called again; the rest of a batch still counts.
  if (!observer_ || cancelled_) return;
  CalibrationProgress progress{.stage = stage_,
                               .evaluations = batch_.asked(),
                               .simulated = batch_.simulated(),
                               .best_cost = best_.cost,
                               .best = {}};
  for (Eigen::Index k = 0; k < best_.point.size(); ++k) {
    const auto& unknown = problem_.unknown(k);
    progress.best.emplace_back(unknown.label, value_in_unit(unknown, best_.point[k]));
  }
  cancelled_ = !observer_(progress);
}

}  // namespace havers::calib
