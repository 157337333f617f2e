// Parts of the result that are read off the answer: parameters with their errors by the slopes, and
// what the calibration did without.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/fit/answer.hpp"

namespace havers::calib {
namespace {

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

CalibratedParameter unfitted(const Unknown& unknown, double position) {
  CalibratedParameter parameter{.name = unknown.label, .unit = std::string(unknown.info->unit)};
  parameter.value = value_in_unit(unknown, position);
  parameter.standard_error = not_given;
  parameter.interval_95 = {not_given, not_given};
  parameter.bounds = {unknown.bounds.first, unknown.bounds.second};
  return parameter;
}

// For active unknown i. slopes_95 may go beyond the bounds, the parameter's interval does not;
// add_hindsight puts the profile's in its place.
void set_error(const Unknown& unknown, const Uncertainty& uncertainty, Eigen::Index i,
               CalibratedParameter& parameter) {
  const bool logarithmic = unknown.info->scale == Scale::logarithmic;
  const double position = to_search(*unknown.info, parameter.value);
  // The error of a logarithm is relative to the value.
  parameter.standard_error = uncertainty.standard_error[i] * (logarithmic ? parameter.value : 1.0);
  parameter.slopes_95 = {from_search(*unknown.info, position + uncertainty.lower[i]),
                         from_search(*unknown.info, position + uncertainty.upper[i])};
  for (const std::size_t end : {0U, 1U})
    parameter.interval_95.at(end) =
        std::clamp(parameter.slopes_95.at(end), unknown.bounds.first, unknown.bounds.second);
}

// (K4) An exponent holds where there was bone to fit it to.
void tell_range_of_porosity(const FitProblem& problem, std::vector<sim::LeftOut>& list) {
  if (problem.study.porosity.to_modulus == ToModulus::none) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t s : problem.fitted) {
    low = std::fmin(low, problem.models[s].porosity);
    high = std::fmax(high, problem.models[s].porosity);
  }
  if (low > high) return;
  list.push_back(
      {fmt::format("E = E₀ (1−p)^m outside p of {:.2g} to {:.2g} %", 100.0 * low, 100.0 * high),
       "no fitted specimen is there; published m run from 2.7 to 10.9"});
}

}  // namespace

std::vector<CalibratedParameter> parameters_of(const FitProblem& problem, const Answer& answer) {
  std::vector<CalibratedParameter> parameters;
  for (std::size_t k = 0; k < problem.unknowns.size(); ++k) {
    const auto& unknown = problem.unknowns[k];
    const auto index = static_cast<Eigen::Index>(k);
    auto parameter = unfitted(unknown, answer.best.point[index]);
    const auto left = std::ranges::find(answer.left, index, &LeftUnknown::unknown);
    if (left != answer.left.end()) parameter.left_out_because = left->reason();

    const auto active = std::ranges::find(answer.active, index);
    if (active != answer.active.end()) {
      parameter.at_bound = at_bound(unknown, answer.best.point[index]);
      parameter.identifiable = !answer.slopes.failed;
      if (parameter.identifiable)
        set_error(unknown, answer.uncertainty, active - answer.active.begin(), parameter);
    }
    if (!parameter.identifiable && parameter.left_out_because.empty())
      parameter.left_out_because = answer.status == CalibrationStatus::budget_spent
                                       ? "the budget ended before the searches did"
                                       : "simulations at the answer or beside it failed";
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

std::vector<sim::LeftOut> left_out_of(const FitProblem& problem, const SimulationBatch& batch,
                                      const Answer& answer) {
  std::vector<sim::LeftOut> list;
  for (const LeftUnknown& one : answer.left)
    list.push_back({problem.unknown(one.unknown).label, one.reason()});
  for (std::size_t s = 0; s < problem.targets.size(); ++s)
    if (!problem.targets[s].usable)
      list.push_back({"specimen " + problem.study.specimens[s].id,
                      "its test gives no modulus, strength and failure strain"});
  for (std::size_t s = 0; s < problem.models.size(); ++s)
    // (K5) Pores larger than a window make joints missing, and no scatter.
    if (problem.models[s].scene.joints.missing != problem.study.model.joints.missing)
      list.push_back({"the scatter that the sections of " + problem.study.specimens[s].id + " give",
                      fmt::format("their pores are larger than a fibre's window: {:.1f} % of the "
                                  "joints are missing instead",
                                  100.0 * problem.models[s].scene.joints.missing)});
  tell_range_of_porosity(problem, list);
  if (batch.asked() > batch.distinct())
    list.push_back(
        {fmt::format("{} of {} simulations", batch.asked() - batch.distinct(), batch.asked()),
         batch.scaled()
             ? "asked for before, or the same but for E and σ₁: in the quasi-static limit stresses "
               "scale with the thresholds and strains with threshold/E"
             : "asked for before"});
  return list;
}

}  // namespace havers::calib
