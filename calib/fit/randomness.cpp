// (F17) How much of the answer is the chance of the replicates: by their variance, and by as many
// replicates again, to which the answer is moved by its slopes instead of by another fit.
#include "calib/fit/randomness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/fit/specimen_effect.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double small_part = 0.05;  // of a residual's variance that replicates may make
constexpr int fewest_replicates = 4;

// Every fitted specimen with seeds that no search has seen.
Evaluation fresh_evaluation(SimulationBatch& batch, const FitProblem& problem,
                            const Answer& answer) {
  Evaluation fresh{.point = answer.best.point, .failed = false};
  const auto count = static_cast<std::size_t>(answer.replicates);
  for (const std::size_t s : problem.fitted) {
    auto scenes = replicate_scenes(problem, fresh.point, s, 2 * answer.replicates);
    scenes.erase(scenes.begin(), scenes.begin() + static_cast<std::ptrdiff_t>(count));
    fresh.predictions.push_back(summarise(batch.run(scenes)));
    fresh.failed = fresh.failed || fresh.predictions.back().failed_point();
  }
  score(problem, answer.weights, fresh);
  return fresh;
}

// Variance of each residual by the chance of the replicates' mean.
VectorXd variance_of_mean(const FitProblem& problem, const Answer& answer) {
  VectorXd variance(answer.best.residuals.size());
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const Prediction& prediction = answer.best.predictions[f];
    const std::size_t s = problem.fitted[f];
    const Landmarks& sd = answer.weights.sd[s];
    variance.segment<landmark_count>(first_row(f)) =
        (slopes_of_residuals(prediction, problem.targets[s], sd) * prediction.sd / sd).square() /
        prediction.usable;
  }
  return variance;
}

// Half widths of the intervals with the weights that the fresh seeds would have led to (F6, F9),
// the answer moved to where its slopes say that it would be.
VectorXd fresh_half_width(const FitProblem& problem, const Answer& answer,
                          const Evaluation& fresh) {
  constexpr int rounds = 5;  // of weights that depend on the answer, and it on them
  Landmarks effect = answer.weights.specimen;
  for (int round = 1;; ++round) {
    const Weights weights = weigh(problem, fresh, answer.weights.scatter, effect);
    const Eigen::MatrixXd slopes = weighed(problem, answer.weights, weights, answer.asked.jacobian);
    Evaluation moved = fresh;
    score(problem, weights, moved);
    // The residuals that the parameters would follow are gone once these have moved; what is left
    // out stays.
    const auto fitted = slopes.leftCols(static_cast<Index>(answer.active.size()));
    const VectorXd by =
        followed(free_columns(problem, moved.point, answer.active, fitted), moved.residuals);
    for (std::size_t f = 0; f < problem.fitted.size(); ++f)
      moved.predictions[f].mean -=
          by.segment<landmark_count>(first_row(f)).array() * weights.sd[problem.fitted[f]];
    score(problem, weights, moved);
    if (round == rounds)
      return uncertainty_of(problem, weights, moved, answer.active, slopes).half_width;
    effect = specimen_effect(problem, weights, moved, slopes);
  }
}

}  // namespace

Randomness randomness_of(SimulationBatch& batch, const FitProblem& problem, const Answer& answer) {
  const Eigen::MatrixXd& follow = answer.uncertainty.follow;
  Randomness result{.replicates = answer.replicates};
  result.replicates_needed = replicates_needed(problem, answer.weights, answer.best);
  result.common_gain = answer.slopes.paired > 0.0 ? answer.slopes.independent / answer.slopes.paired
                                                  : std::numeric_limits<double>::infinity();
  // Variance of each unknown by chance, as part of all of its variance.
  const VectorXd chance = follow.array().square().matrix() * variance_of_mean(problem, answer);
  const VectorXd whole = answer.uncertainty.standard_error.array().square();
  result.simulator_share = (chance.array() / whole.array()).maxCoeff();

  const Evaluation fresh = fresh_evaluation(batch, problem, answer);
  if (fresh.failed) return result;
  result.fresh_cost = fresh.cost;
  const VectorXd shift = follow * (fresh.residuals - answer.best.residuals);
  result.fresh_shift = (shift.array().abs() / answer.uncertainty.standard_error.array()).maxCoeff();
  const VectorXd widths =
      (fresh_half_width(problem, answer, fresh).array() / answer.uncertainty.half_width.array());
  Index most = 0;
  // In logarithms, as half as wide is as bad as twice.
  widths.array().log().abs().maxCoeff(&most);
  result.fresh_width = widths[most];
  return result;
}

int replicates_needed(const FitProblem& problem, const Weights& weights, const Evaluation& at) {
  double worst = 0.0;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const auto told = tells(at.predictions[f], problem.targets[s]);
    for (const Landmark q : {modulus, strength}) {
      const double one_draw = 1.0 + 1.0 / at.predictions[f].usable;  // and the mean of n (F6)
      const double part = std::pow(weights.replicates[s][q] / weights.sd[s][q], 2) / one_draw;
      if (told[q]) worst = std::max(worst, part);
    }
  }
  return std::max(static_cast<int>(std::ceil(worst / small_part)), fewest_replicates);
}

}  // namespace havers::calib
