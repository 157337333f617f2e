#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/fit/answer.hpp"
#include "calib/fit/curve_band.hpp"

namespace havers::calib {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

CalibratedParameter unfitted(const Unknown& unknown, double position) {
  CalibratedParameter parameter{.name = unknown.label, .unit = std::string(unknown.info->unit)};
  parameter.value = from_search(*unknown.info, position);
  parameter.standard_error = nothing;
  parameter.interval_95 = {nothing, nothing};
  parameter.bounds = {from_search(*unknown.info, unknown.lower),
                      from_search(*unknown.info, unknown.upper)};
  return parameter;
}

void set_error(const Unknown& unknown, const Uncertainty& uncertainty, Eigen::Index i,
               CalibratedParameter& parameter) {
  const bool logarithmic = unknown.info->scale == Scale::logarithmic;
  const double position = to_search(*unknown.info, parameter.value);
  const double half = uncertainty.half_width[i];
  parameter.standard_error = uncertainty.standard_error[i] * (logarithmic ? parameter.value : 1.0);
  parameter.interval_95 = {from_search(*unknown.info, position - half),
                           from_search(*unknown.info, position + half)};
}

/// Responses that answered, and one of their numbers over them.
Spread spread_of(const std::vector<Response>& responses, double Response::*number) {
  Spread spread;
  double n = 0.0;
  for (const auto& response : responses) {
    if (response.failed) continue;
    spread.mean += response.*number;
    ++n;
  }
  if (n == 0.0) return {nothing, nothing};
  spread.mean /= n;
  for (const auto& response : responses)
    if (!response.failed) spread.sd += std::pow(response.*number - spread.mean, 2);
  spread.sd = std::sqrt(spread.sd / std::max(n - 1.0, 1.0));
  return spread;
}

// Modulus, strength, failure strain; the last follows from the landmarks, ε = σ / (E · linearity).
std::array<double, 3> standardised(const Prediction& prediction, const Target& target,
                                   const Landmarks& extra_variance) {
  if (!target.usable || prediction.usable == 0) return {nothing, nothing, nothing};
  const Landmarks distance = difference(prediction, target);
  const Landmarks own = prediction.sd.square() * (1.0 + 1.0 / prediction.usable);
  const Landmarks variance = target.noise.square() + own + extra_variance;
  const double strain = distance[strength] - distance[modulus] - distance[linearity];
  return {distance[modulus] / std::sqrt(variance[modulus]),
          distance[strength] / std::sqrt(variance[strength]), strain / std::sqrt(variance.sum())};
}

SpecimenResult result_of(const FitProblem& problem, const Answer& answer, std::size_t s,
                         const std::vector<Response>& responses) {
  const auto& specimen = problem.study.specimens[s];
  const auto& model = problem.models[s];
  SpecimenResult result{.id = specimen.id,
                        .use = specimen.use,
                        .orientation = specimen.orientation,
                        .porosity = model.porosity,
                        .scatter = model.scene.joints.scatter,
                        .measured = specimen.test,
                        .modulus = spread_of(responses, &Response::modulus),
                        .strength = spread_of(responses, &Response::strength),
                        .failure_strain = spread_of(responses, &Response::failure_strain)};
  if (const auto scatter =
          value_at(problem.unknowns, answer.best.point, *find_parameter("scatter"), s))
    result.scatter = *scatter;
  const auto prediction = summarise(responses);
  Landmarks extra = answer.weights.specimen.square();
  if (!answer.weights.scatter.empty()) extra += answer.weights.scatter[s].square();
  result.residual = standardised(prediction, problem.targets[s], extra);
  result.band = band_of(responses, specimen.test);
  result.failed_simulations = prediction.failed();
  return result;
}

}  // namespace

std::vector<CalibratedParameter> parameters_of(const FitProblem& problem, const Answer& answer) {
  std::vector<CalibratedParameter> parameters;
  for (std::size_t k = 0; k < problem.unknowns.size(); ++k) {
    const auto& unknown = problem.unknowns[k];
    const auto index = static_cast<Eigen::Index>(k);
    auto parameter = unfitted(unknown, answer.best.point[index]);
    const auto left = std::ranges::find(answer.left, index, &LeftUnknown::unknown);
    if (left != answer.left.end()) parameter.left_out_because = left->because;

    const auto active = std::ranges::find(answer.active, index);
    if (active != answer.active.end()) {
      parameter.at_bound = at_bound(unknown, answer.best.point[index]);
      parameter.identifiable = !answer.slopes.failed;
      if (parameter.identifiable)
        set_error(unknown, answer.uncertainty, active - answer.active.begin(), parameter);
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

std::vector<SpecimenResult> specimens_of(const FitProblem& problem, SimulationBatch& batch,
                                         const Answer& answer) {
  std::vector<SpecimenResult> results;
  for (std::size_t s = 0; s < problem.study.specimens.size(); ++s) {
    const auto responses = batch.run(
        replicate_scenes(problem, answer.best.point, s, problem.study.calibrate.replicates));
    results.push_back(result_of(problem, answer, s, responses));
  }
  return results;
}

std::vector<sim::LeftOut> left_out_of(const FitProblem& problem, const SimulationBatch& batch,
                                      const Answer& answer) {
  std::vector<sim::LeftOut> list;
  for (const auto& [unknown, because] : answer.left)
    list.push_back({problem.unknowns[static_cast<std::size_t>(unknown)].label, because});
  for (std::size_t s = 0; s < problem.targets.size(); ++s)
    if (!problem.targets[s].usable)
      list.push_back({"specimen " + problem.study.specimens[s].id,
                      "its test gives no modulus, strength and failure strain"});
  if (batch.asked() > batch.distinct())
    list.push_back(
        {fmt::format("{} of {} simulations", batch.asked() - batch.distinct(), batch.asked()),
         "asked for before, or the same but for E and σ₁: in the quasi-static limit stresses scale "
         "with the thresholds and strains with threshold/E"});
  return list;
}

}  // namespace havers::calib
