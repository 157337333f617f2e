#include "calib/fit/left_out.hpp"

#include <algorithm>
#include <vector>

#include "calib/fit/search.hpp"
#include "calib/fit/walk.hpp"

namespace havers::calib {
namespace {

// Rise of the cost by which specimens contradict a value: chi² of 95 %, halved.
constexpr double contradicts = 1.92;

// The trail's best point, but for what is left out, which is where the study has it.
Evaluation as_in_study(Trail& trail, const std::vector<LeftUnknown>& left) {
  Point point = trail.best().point;
  for (const LeftUnknown& one : left)
    point[one.unknown] = trail.problem().unknown(one.unknown).start;
  return trail.evaluate(point);
}

}  // namespace

void put_back(Trail& trail, const std::vector<LeftUnknown>& left) {
  if (const Evaluation own = as_in_study(trail, left); !own.failed)
    trail.restart(trail.weights(), own);
}

void leave_out(Trail& trail, std::vector<LeftUnknown> left, Answer& answer) {
  // The study's values are tried, with the other unknowns refitted; if the specimens contradict
  // them, all stays as it was found.
  const Evaluation found = trail.best();
  answer.active = without(answer.active, left);
  trail.restart(trail.weights(), as_in_study(trail, left));
  search_ceres(trail, trail.best(), answer.active);
  // A trail that was stopped may have no simulation of where the study has them.
  if (trail.best().failed || trail.best().cost > found.cost + contradicts) {
    for (auto& one : left) one.kept_where_found = !trail.stopped();
    trail.restart(trail.weights(), found);
  }
  answer.left.insert(answer.left.end(), left.begin(), left.end());
}

bool mend_left_out(Trail& trail, const Eigen::MatrixXd& jacobian, Answer& answer) {
  if (trail.problem().study.calibrate.automatic) return false;
  for (LeftUnknown& one : answer.left) {
    // A walk scores each point by weights of its own; the trail's make them comparable with its
    // best point.
    auto walked = walk_along(trail, one.unknown, answer.active, jacobian);
    for (Evaluation& point : walked) score(trail.problem(), trail.weights(), point);
    const auto lowest = std::ranges::min_element(walked, {}, &Evaluation::cost);
    if (lowest == walked.end() || lowest->cost > trail.best().cost - contradicts) continue;
    // One at a time: the caller weighs and searches anew.
    Active along = answer.active;
    along.push_back(one.unknown);
    trail.restart(trail.weights(), search_ceres(trail, *lowest, along).best);
    one.kept_where_found = true;
    return true;
  }
  return false;
}

Active asked_and_left(const FitProblem& problem, const Answer& answer) {
  Active unknowns;
  if (!problem.study.calibrate.automatic)
    for (const LeftUnknown& one : answer.left) unknowns.push_back(one.unknown);
  return unknowns;
}

AskedSlopes with_left_out(Trail& trail, const Answer& answer, const Differences& fitted) {
  const Evaluation best = trail.best();
  const Active left = asked_and_left(trail.problem(), answer);
  const auto others = differentiate(trail, best, left, slope_step);
  // A point at which an unknown left out has moved is no answer, however low its cost.
  trail.restart(trail.weights(), best);
  AskedSlopes all{fitted.jacobian, answer.active};
  if (others.failed) return all;
  std::vector<Eigen::Index> moving;
  for (Eigen::Index k = 0; k < others.jacobian.cols(); ++k) {
    const Eigen::Index unknown = left[static_cast<std::size_t>(k)];
    // One standard deviation of the residuals over all its bounds (F9).
    if (others.jacobian.col(k).norm() * trail.problem().unknown(unknown).range() < 1.0) continue;
    moving.push_back(k);
    all.unknowns.push_back(unknown);
  }
  const Eigen::MatrixXd beside = others.jacobian(Eigen::all, moving);
  all.jacobian.conservativeResize(Eigen::NoChange, fitted.jacobian.cols() + beside.cols());
  all.jacobian.rightCols(beside.cols()) = beside;
  return all;
}

Eigen::MatrixXd chosen_slopes(const Answer& answer) {
  std::vector<Eigen::Index> chosen;
  for (std::size_t k = 0; k < answer.asked.unknowns.size(); ++k) {
    const auto left =
        std::ranges::find(answer.left, answer.asked.unknowns[k], &LeftUnknown::unknown);
    if (left == answer.left.end() || left->kept_where_found)
      chosen.push_back(static_cast<Eigen::Index>(k));
  }
  return answer.asked.jacobian(Eigen::all, chosen);
}

}  // namespace havers::calib
