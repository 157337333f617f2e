// The search of README.md, step by step: screen with few replicates, search globally with as few,
// search and weigh in turn with all of them, then assess. Every answer is the trail's best point;
// what a search returns is for the log and to compare starts by.
#include "calib/fit/calibrate.hpp"

#include <algorithm>

#include "calib/fit/answer.hpp"
#include "calib/fit/left_out.hpp"
#include "calib/fit/profile.hpp"
#include "calib/fit/randomness.hpp"
#include "calib/fit/search.hpp"
#include "calib/fit/specimen_effect.hpp"
#include "calib/fit/walk.hpp"

namespace havers::calib {
namespace {

// Step of the derivatives by which unknowns are screened: wide, because few replicates are noisy.
constexpr double screening_step = 0.2;
// Replicates that are enough to find the neighbourhood of the answer.
constexpr int scouting_replicates = 3;
constexpr int most_rounds = 8;  // of search and weights; after so many they are said not to agree
// Cost that a search may leave on the table: a fifth of a standard deviation (½·0.2²).
constexpr double close_enough = 0.02;

// (F6) Of every specimen of the study.
std::vector<Landmarks> porosity_errors(Trail& trail, const Evaluation& at) {
  const FitProblem& problem = trail.problem();
  std::vector<Landmarks> errors(problem.models.size(), Landmarks(Landmarks::Zero()));
  for (std::size_t f = 0; f < problem.fitted.size(); ++f)
    errors[problem.fitted[f]] =
        porosity_error(problem, trail.batch(), at.point, problem.fitted[f], at.predictions[f]);
  return errors;
}

// The trail begins at the study's start or, where the simulations have no answer there, at the
// middle of the bounds, with weights as if specimens were alike. False where they have none at
// either.
bool find_a_start(Trail& trail, int replicates) {
  const FitProblem& problem = trail.problem();
  trail.set_replicates(replicates);
  const auto both =
      predict(problem, trail.batch(),
              {start_point(problem.unknowns), middle_point(problem.unknowns)}, trail.replicates());
  for (const auto& evaluation : both) {
    if (evaluation.failed) continue;
    trail.restart(weigh(problem, evaluation, porosity_errors(trail, evaluation), Landmarks::Zero()),
                  evaluation);
    return true;
  }
  return false;
}

// Unknowns that the specimens inform neither at the start nor at the middle of the bounds: what
// tells nothing at one point only may tell elsewhere. Where slopes can be had at neither point,
// nothing is left out.
std::vector<LeftUnknown> screen(Trail& trail, const Active& all) {
  trail.enter("what the specimens inform");
  std::vector<LeftUnknown> left;
  bool first = true;
  for (const auto& point : {trail.best().point, middle_point(trail.problem().unknowns)}) {
    const auto here = trail.evaluate(point);
    if (here.failed) continue;
    const auto slopes = differentiate(trail, here, all, screening_step);
    if (slopes.failed) continue;
    const auto now = uninformed(trail.problem(), point, all, slopes);
    if (first) left = now;
    std::erase_if(left, [&](const LeftUnknown& one) {
      return std::ranges::find(now, one.unknown, &LeftUnknown::unknown) == now.end();
    });
    first = false;
  }
  return left;
}

// One search from the trail's best point: least squares, if the study wants them or nothing is
// costly; then, to `polish`, Sbplx over the costly unknowns.
void search(Trail& trail, const Active& active, bool polish, Answer& answer) {
  const auto split = split_by_cost(trail.problem(), trail.batch(), trail.best().point, active);
  trail.enter("least squares");
  if (trail.problem().study.calibrate.smooth || split.costly.empty())
    answer.stages.push_back(search_ceres(trail, trail.best(), active).log);
  if (!polish || split.costly.empty()) return;
  trail.enter("polish");
  answer.stages.push_back(search_nlopt(trail, trail.best(), split, Stride::polish).log);
}

// With the scatters' errors as they count at the best point.
void reweigh(Trail& trail, const Landmarks& effect) {
  const Evaluation best = trail.best();
  trail.restart(weigh(trail.problem(), best, porosity_errors(trail, best), effect), best);
}

// By the slopes at the best point; none where these fail.
Landmarks effect_at_best(Trail& trail, const Active& active) {
  const auto slopes = differentiate(trail, trail.best(), active, slope_step);
  if (slopes.failed) return Landmarks::Zero();
  return specimen_effect(trail.problem(), trail.weights(), trail.best(), slopes.jacobian);
}

// As many as were asked for, or as the weights where the scouts ended say are needed.
void choose_replicates(Trail& trail, Answer& answer) {
  if (trail.problem().study.calibrate.replicates != replicates_by_need) return;
  reweigh(trail, effect_at_best(trail, answer.active));
  answer.replicates = replicates_needed(trail.problem(), trail.weights(), trail.best());
}

// From here on, at the best point of the scouts; false where they fail there.
bool take_all_replicates(Trail& trail, int replicates) {
  trail.set_replicates(replicates);
  trail.restart(
      trail.weights(),
      predict(trail.problem(), trail.batch(), {trail.best().point}, trail.replicates()).front());
  return !trail.best().failed;
}

// Search, weigh anew, search again, until weights and answer agree. The first weights come from
// where the scouts ended: without them the first search would chase what is a specimen's own.
// Whether they do.
bool alternate_search_and_weights(Trail& trail, Answer& answer) {
  bool rough = !trail.problem().study.calibrate.smooth, polished = false;
  Landmarks effect = effect_at_best(trail, answer.active);
  for (int round = 0; round < most_rounds && !trail.stopped(); ++round) {
    reweigh(trail, effect);
    search(trail, answer.active, rough, answer);
    polished = polished || rough;
    const auto slopes = differentiate(trail, trail.best(), answer.active, slope_step);
    if (slopes.failed) continue;
    // Unknowns that the screening found to be informed may not be so here (F10): the search goes on
    // with the others.
    auto left = uninformed(trail.problem(), trail.best().point, answer.active, slopes);
    if (!left.empty()) {
      leave_out(trail, std::move(left), answer);
      if (answer.active.empty() || trail.best().failed) return true;
      continue;
    }
    const auto before = effect;
    const auto all = with_left_out(trail, answer, slopes).jacobian;
    effect = specimen_effect(trail.problem(), trail.weights(), trail.best(), all);
    const auto error =
        uncertainty_of(trail.problem(), trail.weights(), trail.best(), answer.active, all);
    // Least squares that stopped short (F12) are polished by the next round, once.
    rough = error.distance >= close_enough && !polished;
    // Weights agree with the answer where the specimen effect stays, to 5 % of it and 1e-4.
    const bool agree = ((effect - before).abs() <= 0.05 * effect + 1e-4).all();
    // mend_left_out comes last, as it walks along each unknown left out, which takes simulations.
    if (!rough && agree && !mend_left_out(trail, slopes.jacobian, answer)) return true;
  }
  return false;
}

// How well the answer is known: slopes, intervals, what was left out, profiles. Where the budget
// ended the searches there is none; once they are done, no budget ends this.
void assess_answer(Trail& trail, Answer& answer) {
  answer.best = trail.best();
  answer.weights = trail.weights();
  if (trail.stopped() || answer.active.empty() || answer.best.failed) return;
  trail.lift_budget();
  trail.enter("uncertainty");
  do {  // a point of the differences may be the best so far, and has slopes of its own
    answer.best = trail.best();
    answer.slopes = differentiate(trail, answer.best, answer.active, slope_step);
  } while (!answer.slopes.failed && trail.best().cost < answer.best.cost);
  answer.best = trail.best();
  if (answer.slopes.failed) return;
  answer.asked = with_left_out(trail, answer, answer.slopes);
  answer.uncertainty = uncertainty_of(trail.problem(), answer.weights, answer.best, answer.active,
                                      answer.asked.jacobian);
  for (const Eigen::Index unknown : asked_and_left(trail.problem(), answer)) {
    trail.enter("unknowns left out");
    std::ranges::move(walk_along(trail, unknown, answer.active, answer.slopes.jacobian),
                      std::back_inserter(answer.elsewhere));
  }
  // Before the profiles, whose ends may be no nearer than those of these intervals.
  if (!answer.elsewhere.empty())
    widen_intervals(answer.best, answer.elsewhere, answer.active, answer.uncertainty);
  trail.enter("profiles");
  if (trail.problem().study.calibrate.profiles) answer.profiles = profiles_of(trail, answer);
}

CalibrationStatus status_of(const Trail& trail, const Answer& answer) {
  if (trail.cancelled()) return CalibrationStatus::cancelled;
  if (answer.active.empty()) return CalibrationStatus::nothing_to_fit;
  if (trail.best().failed) return CalibrationStatus::all_failed;
  if (trail.budget_spent()) return CalibrationStatus::budget_spent;
  return CalibrationStatus::converged;
}

Answer solve(Trail& trail) {
  const FitProblem& problem = trail.problem();
  const int all = all_replicates(problem.study.calibrate);
  Answer answer{.replicates = all};
  answer.best.point = start_point(problem.unknowns);
  if (problem.fitted.empty() || problem.unknowns.empty()) {
    answer.status = CalibrationStatus::nothing_to_fit;
    return answer;
  }
  // With few replicates a specimen may fail that with all of them has answers enough.
  if (!find_a_start(trail, std::min(scouting_replicates, all)) && !find_a_start(trail, all))
    return answer;

  for (std::size_t k = 0; k < problem.unknowns.size(); ++k)
    answer.active.push_back(static_cast<Eigen::Index>(k));
  answer.left = screen(trail, answer.active);
  answer.active = without(answer.active, answer.left);
  // By now the trail's best may be one of the points beside the start or the middle of the bounds.
  if (!answer.left.empty()) put_back(trail, answer.left);
  if (!answer.active.empty()) {
    auto [starts, ends, logs] = search_globally(trail, answer.active);
    answer.starts = std::move(starts);
    answer.ends = std::move(ends);
    answer.stages = std::move(logs);
    choose_replicates(trail, answer);
    if (take_all_replicates(trail, answer.replicates))
      answer.agrees = alternate_search_and_weights(trail, answer);
  }
  assess_answer(trail, answer);
  answer.status = status_of(trail, answer);
  return answer;
}

}  // namespace

CalibrationResult calibrate_with(const Simulator& simulator, const Study& study,
                                 EvaluationStore* store, const CalibrationObserver& observer) {
  const FitProblem problem = make_problem(study);
  SimulationBatch batch(simulator, store, study.calibrate.threads);
  Trail trail(problem, batch, observer);
  Answer answer = solve(trail);

  CalibrationResult result{.stages = answer.stages, .scene = study.model, .cost = answer.best.cost};
  result.parameters = parameters_of(problem, answer);
  result.specimens = specimens_of(problem, batch, answer);
  if (!problem.fitted.empty()) {
    // The first in the order of the study; `fitted` is ordered by ids.
    const std::size_t first = std::ranges::min(problem.fitted);
    result.scene = replicate_scenes(problem, answer.best.point, first, 1).front();
    result.scene_of = study.specimens[first].id;
  }
  // Where no point has an answer, the few replicates that have one do not make a cost.
  if (answer.status != CalibrationStatus::all_failed)
    result.cost = cost_of(result.specimens, answer.best.cost);
  std::ranges::copy(answer.weights.specimen, result.specimen_effect.begin());
  add_hindsight(problem, batch, answer, result);
  result.left_out = left_out_of(problem, batch, answer);
  // A stop may come as late as in the hindsight.
  if (batch.stopped()) answer.status = CalibrationStatus::cancelled;
  result.status = answer.status;
  result.evaluations = batch.asked();
  result.simulated = batch.simulated();
  result.failed_simulations = batch.failed();
  result.most_failed_because = batch.most_failed_because();
  result.reserved_simulations = batch.reserved();
  result.most_reserved_because = batch.most_reserved_because();
  result.distinct_simulations = batch.distinct();
  result.verdict = verdict_of(problem, answer, result);
  return result;
}

}  // namespace havers::calib
