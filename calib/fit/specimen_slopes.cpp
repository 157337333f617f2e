// A study of the specimen alone, in which it counts as fitted, is simulated at points beside the
// answer: central differences as for the fitted specimens (F8), but of the landmarks themselves.
#include "calib/fit/specimen_slopes.hpp"

#include <algorithm>

namespace havers::calib {

using Eigen::Index;

Eigen::MatrixXd specimen_slopes(SimulationBatch& batch, const FitProblem& problem,
                                const Answer& answer, const Specimen& specimen, std::size_t as) {
  Study alone = problem.study;
  alone.specimens = {specimen};
  alone.specimens.front().use = Use::fit;
  FitProblem one = make_problem(alone);
  one.unknowns = problem.unknowns;  // "auto" may try others for this specimen alone
  // It is specimen 0 here, and has the unknowns that act on `as` in the whole study.
  for (Unknown& unknown : one.unknowns) {
    const bool has = std::ranges::find(unknown.specimens, as) != unknown.specimens.end();
    unknown.specimens.assign(has ? 1 : 0, 0);
  }

  const auto found = predict(
      one, batch, moved_points(problem.unknowns, answer.best.point, answer.active, slope_step),
      answer.replicates);
  Eigen::MatrixXd slopes(landmark_count, static_cast<Index>(answer.active.size()));
  for (std::size_t i = 0; i < answer.active.size(); ++i) {
    const auto &low = found[2 * i], &high = found[2 * i + 1];
    const double span = (high.point - low.point).norm();
    if (low.failed || high.failed || !(span > 0.0)) return {};
    slopes.col(static_cast<Index>(i)) =
        (high.predictions.front().mean - low.predictions.front().mean) / span;
  }
  return slopes;
}

}  // namespace havers::calib
