// The verdict as a list of checks. Here are those of the searches and of the simulations, and what
// remains of a verdict where there is no answer; the others have files of their own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "calib/fit/answer.hpp"
#include "calib/fit/answer_checks.hpp"
#include "calib/fit/left_out.hpp"
#include "calib/fit/model_checks.hpp"
#include "calib/fit/parameter_checks.hpp"
#include "calib/fit/porosity_check.hpp"
#include "calib/fit/section_check.hpp"

namespace havers::calib {
namespace {

// `cost` is the result's, as everywhere on its page.
Check check_convergence(const Answer& answer, double cost) {
  constexpr double close_enough = 0.05;  // of ½χ²: a third of a standard deviation
  const std::string what = explain(answer.status);
  if (answer.status == CalibrationStatus::budget_spent)
    return {"converged", Outcome::fail,
            what +
                ": raise calibrate.options.budget and run again into the same folder (--force), "
                "which keeps the simulations"};
  if (answer.status != CalibrationStatus::converged)
    return {"converged", Outcome::fail, "No answer: " + what + "."};
  if (answer.slopes.failed)
    return {"converged", Outcome::fail,
            "The searches stopped, but simulations beside the answer failed, so that no interval "
            "could be given. Narrow calibrate.bounds to where the model can be simulated."};
  if (!answer.agrees)
    return {"converged", Outcome::warn,
            "The searches stopped, but with what they came to the weights change: more replicates "
            "make the simulated outcome smoother."};
  if (answer.uncertainty.distance > close_enough)
    return {"converged", Outcome::warn,
            fmt::format("The searches stopped, but the slope promises a cost lower by {:.2g}: more "
                        "replicates make the simulated outcome smoother.",
                        answer.uncertainty.distance)};
  return {"converged", Outcome::pass,
          fmt::format("The searches stopped at a minimum, cost {:.3g}.", cost)};
}

// The searches' ends, best first, by the weights of the answer: those of the searches do not know
// how much specimens differ.
std::vector<Evaluation> ends_of(const FitProblem& problem, const Answer& answer) {
  auto ends = answer.ends;
  for (Evaluation& end : ends) score(problem, answer.weights, end);
  std::ranges::stable_sort(ends, {}, &Evaluation::cost);
  return ends;
}

// Starts agree when they end at the same cost and, where they do, at the same point within its
// errors.
Check check_starts(const FitProblem& problem, const Answer& answer) {
  if (answer.ends.empty() || answer.best.failed)
    return not_checked("starts agree", "no search came to an answer.");
  if (answer.ends.size() < 2)
    return {"starts agree", Outcome::warn,
            "Only one start gave an answer; nothing to compare it with."};
  const auto ends = ends_of(problem, answer);
  const auto& best = ends.front();
  // Half of χ² = 1: a standard deviation of one parameter.
  const auto is_low = [&](const Evaluation& end) { return end.cost <= best.cost + 0.5; };
  // What was searched along then, and is left out by now, moves the others.
  const auto& half = answer.uncertainty.half_width;
  const auto is_compared = [&](const Evaluation& end) {
    const auto moved = [&](const LeftUnknown& one) {
      return end.point[one.unknown] != best.point[one.unknown];
    };
    return half.size() > 0 && std::ranges::none_of(answer.left, moved);
  };
  const auto is_elsewhere = [&](const Evaluation& end) {
    if (!is_low(end) || !is_compared(end)) return false;
    const Eigen::ArrayXd apart = (end.point - best.point)(answer.active).array().abs();
    return (apart > 2.0 * half.array() + 0.02).any();
  };
  const auto same_cost = std::ranges::count_if(ends, is_low);
  const bool compared =
      std::ranges::all_of(ends, [&](const auto& end) { return !is_low(end) || is_compared(end); });
  const auto elsewhere = std::ranges::count_if(ends, is_elsewhere);
  if (elsewhere > 0)
    return {"starts agree", Outcome::fail,
            fmt::format("{} of {} starts {} at another point that fits as well: the answer is not "
                        "unique. Narrow calibrate.bounds or add specimens.",
                        elsewhere, ends.size(), elsewhere == 1 ? "ends" : "end")};
  if (same_cost < 2)
    return {"starts agree", Outcome::warn,
            fmt::format(
                "Only one of {} starts reached the lowest cost; the next stopped {:.2g} above it.",
                ends.size(), ends[1].cost - best.cost)};
  return {"starts agree", Outcome::pass,
          fmt::format("{} of {} starts came to the same {}.", same_cost, ends.size(),
                      compared ? "point" : "cost")};
}

// Where there is no answer, nothing of it passes.
void leave_unchecked(std::vector<Check>& checks, const char* because) {
  for (Check& check : checks)
    if (check.outcome == Outcome::pass && check.done) check = not_checked(check.check, because);
}

// What holds of a point that no search came to says nothing of the answer.
void leave_all_unchecked(std::vector<Check>& checks, const char* because) {
  for (Check& check : checks)
    if (check.check != "converged") check = not_checked(check.check, because);
}

std::vector<std::string> missed(const FitProblem& problem, const Answer& answer) {
  std::vector<std::string> labels;
  for (const Eigen::Index k : asked_and_left(problem, answer))
    labels.push_back(problem.unknown(k).label);
  return labels;
}

// Those of which more than a quarter of the replicates at the answer failed: the others are no fair
// sample of their strengths.
std::vector<std::string> often_failed(const CalibrationResult& result) {
  std::vector<std::string> ids;
  for (const SpecimenResult& specimen : result.specimens)
    if (4 * specimen.failed_simulations > static_cast<int>(specimen.replicates.size()))
      ids.push_back(specimen.id);
  return ids;
}

Check check_simulations(const CalibrationResult& result) {
  constexpr const char* name = "simulations";
  const auto share = [&](long some) {
    return some == 0 ? 0.0
                     : static_cast<double>(some) / static_cast<double>(result.distinct_simulations);
  };
  const double failed = share(result.failed_simulations);
  const std::vector<std::string> often = often_failed(result);
  const std::string text = fmt::format("{} of {} different simulations failed",
                                       result.failed_simulations, result.distinct_simulations);
  if (failed > 0.05 || !often.empty()) {
    const std::string& why = result.most_failed_because;
    const bool helps = why.find(';') != std::string::npos;  // what does stands behind it
    return {name, failed <= 0.2 ? Outcome::warn : Outcome::fail,
            fmt::format(
                "{}{}, most often so: {}.{}", text,
                often.empty() || failed > 0.2
                    ? ""
                    : fmt::format(", more than a quarter of those of {}", fmt::join(often, ", ")),
                why,
                helps ? ""
                      : " None would within calibrate.bounds that keep to where the model "
                        "can be simulated.")};
  }
  if (share(result.reserved_simulations) > 0.05)
    return {name, Outcome::warn,
            fmt::format("{}; {} have a reservation, most often so: {}.", text,
                        result.reserved_simulations, result.most_reserved_because)};
  return {name, Outcome::pass,
          text + (failed > 0.0 ? "; the replicates that answered stand in for them." : ".")};
}

}  // namespace

Check not_checked(const std::string& check, const std::string& why) {
  return {check, Outcome::pass, "Not checked: " + why, false};
}

std::vector<Check> verdict_of(const FitProblem& problem, const Answer& answer,
                              const CalibrationResult& result) {
  std::vector<Check> checks{check_brittle(problem, answer)};
  checks.push_back(check_convergence(answer, result.cost));
  checks.push_back(check_starts(problem, answer));
  checks.push_back(check_bounds(problem, answer, result));
  checks.push_back(check_identifiable(problem, answer, result));
  checks.push_back(check_records(problem));
  checks.push_back(check_broke(problem, answer));
  checks.push_back(check_strain(problem, answer));
  checks.push_back(check_toe(problem, answer));
  checks.push_back(check_orientations(problem, answer));
  checks.push_back(check_sections(problem));
  checks.push_back(check_porosity(problem, answer));
  checks.push_back(check_specimen_spread(problem, answer));
  // Weibull's modulus is about the same spread, and so its sentence is part of that check.
  checks.back().text += weibull_sentence(result, one_sided_orientations(problem, answer.best));
  checks.push_back(check_plain_law(problem, answer));
  checks.push_back(check_correlation(result));
  checks.push_back(check_intervals(problem, result));
  checks.push_back(check_influence(result));
  checks.push_back(check_randomness(result));
  checks.push_back(check_confirmation(problem, result));
  checks.push_back(check_validation(result, missed(problem, answer)));
  checks.push_back(check_censored(result));
  if (answer.best.failed)
    leave_unchecked(checks, "there is no answer.");
  else if (answer.status == CalibrationStatus::budget_spent)
    leave_all_unchecked(checks, "the budget ended before the searches did.");
  else if (answer.active.empty())
    leave_unchecked(checks, "no parameter is fitted.");
  // How many simulations failed is told even where there is no answer.
  checks.push_back(check_simulations(result));
  return checks;
}

}  // namespace havers::calib
