// Each specimen at the answer: what was measured, what was simulated, what every term costs.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "calib/fit/answer.hpp"
#include "calib/fit/curve_band.hpp"
#include "calib/fit/replicate_spread.hpp"
#include "calib/fit/specimen_slopes.hpp"
#include "calib/fit/statistics.hpp"

namespace havers::calib {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// One of the numbers of the responses that answered; a single one has no spread that is known.
Spread spread_of(const std::vector<Response>& responses, double Response::*number) {
  std::vector<double> values;
  for (const auto& response : responses)
    if (!response.failed) values.push_back(response.*number);
  const Statistics statistics = statistics_of(values);
  return {statistics.mean, statistics.n == 1 ? 0.0 : statistics.sd};
}

std::vector<ReplicateResult> replicates_of(const std::vector<sim::Scene>& scenes,
                                           const std::vector<Response>& responses) {
  std::vector<ReplicateResult> results;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const Response& response = responses[i];
    ReplicateResult& result = results.emplace_back();
    result.seed = scenes[i].joints.seed;
    result.failed = response.failed;
    if (response.failed) continue;
    const Landmarks landmarks = landmarks_of(response);
    result.broke = response.broke;
    result.modulus = response.modulus;
    result.strength = response.strength;
    result.failure_strain = response.failure_strain;
    result.pre_peak = landmarks[pre_peak];
    result.energy = landmarks[energy];
    result.post_peak = landmarks[post_peak];
  }
  return results;
}

// Standard deviations of a specimen's landmarks beside the machine's.
struct Sources {
  Landmarks replicates;  // of one draw of the model
  Landmarks scatter, specimens, parameters;
};

// (F6), (F7), term by term.
std::vector<TermResult> terms_of(const Prediction& prediction, const Target& target,
                                 const Sources& sources) {
  std::vector<TermResult> terms;
  if (!target.usable || prediction.usable == 0) return terms;
  const Landmarks replicates = sources.replicates * std::sqrt(1.0 + 1.0 / prediction.usable);
  const Landmarks sd = (target.noise.square() + replicates.square() + sources.scatter.square() +
                        sources.specimens.square() + sources.parameters.square())
                           .sqrt();
  const Landmarks residuals = residuals_of(prediction, target, sd);
  for (Eigen::Index q = 0; q < landmark_count; ++q) {
    if (!target.present[q] || !std::isfinite(sd[q])) continue;
    TermResult term{.term = std::string(name_of(static_cast<Landmark>(q)))};
    term.measured = target.value[q];
    term.simulated = prediction.mean[q];
    term.machine = target.noise[q];
    term.replicates = replicates[q];
    term.scatter = sources.scatter[q];
    term.specimens = sources.specimens[q];
    term.parameters = sources.parameters[q];
    term.sd = sd[q];
    term.residual = residuals[q];
    term.bound = q == strength && has_bound(prediction, target);
    terms.push_back(std::move(term));
  }
  return terms;
}

// Modulus, strength, failure strain; the last follows from the landmarks, ε = σ / (E · linearity).
// NaN where a landmark that it takes is no term.
std::array<double, 3> standardised(const std::vector<TermResult>& terms) {
  const auto of = [&](Landmark q) {
    const auto found = std::ranges::find(terms, name_of(q), &TermResult::term);
    return found == terms.end() ? TermResult{.sd = 1.0, .residual = no_number} : *found;
  };
  const TermResult e = of(modulus), s = of(strength), straight = of(linearity);
  const double strain = s.residual * s.sd - e.residual * e.sd - straight.residual * straight.sd;
  return {e.residual, s.residual, strain / std::hypot(e.sd, s.sd, straight.sd)};
}

/// A specimen's replicates at the answer.
struct Simulated {
  std::vector<sim::Scene> scenes;
  std::vector<Response> responses;
  Prediction prediction;
};

// In the order of the study. Those of fitted specimens are in the batch's memory as a rule.
std::vector<Simulated> simulate_all(const FitProblem& problem, SimulationBatch& batch,
                                    const Answer& answer) {
  std::vector<Simulated> all;
  for (std::size_t s = 0; s < problem.study.specimens.size(); ++s) {
    auto scenes = replicate_scenes(problem, answer.best.point, s, answer.replicates);
    auto responses = batch.run(scenes);
    auto prediction = summarise(responses);
    all.push_back({std::move(scenes), std::move(responses), std::move(prediction)});
  }
  return all;
}

// (F6) Standard deviations of one draw of the model, for each specimen of the study.
std::vector<Landmarks> spread_of(const FitProblem& problem, const std::vector<Simulated>& all) {
  std::vector<Replicated> replicated;
  for (std::size_t s = 0; s < all.size(); ++s) {
    // A specimen that is not fitted changes nothing of the others: its spread is its own.
    const bool fitted = std::ranges::find(problem.fitted, s) != problem.fitted.end();
    Replicated& one = replicated.emplace_back(replicated_of(
        problem.study.specimens[s].orientation, all[s].scenes.front().joints, all[s].prediction));
    if (!fitted) one.scatter = 0.0;
  }
  return replicate_spread(replicated);
}

SpecimenResult result_of(const FitProblem& problem, std::size_t s, const Simulated& simulated) {
  const auto& [scenes, responses, prediction] = simulated;
  const auto& specimen = problem.study.specimens[s];
  SpecimenResult result{.id = specimen.id,
                        .use = specimen.use,
                        .orientation = specimen.orientation,
                        .porosity = problem.models[s].porosity,
                        .scatter = scenes.front().joints.scatter,
                        .measured = specimen.test,
                        .modulus = spread_of(responses, &Response::modulus),
                        .strength = spread_of(responses, &Response::strength),
                        .failure_strain = spread_of(responses, &Response::failure_strain)};
  result.measured.broke = specimen.broke;  // the study has the last word
  result.replicates = replicates_of(scenes, responses);
  result.band = band_of(responses, specimen.test);
  result.failed_simulations = prediction.failed();
  return result;
}

// (F24) A specimen in none of the groups of a parameter (calibrate.level) has their mean, and is
// off by what they differ; by how much is not told by one of them: infinite.
Landmarks variance_of_groups(const FitProblem& problem, const Answer& answer, std::size_t s,
                             const Eigen::MatrixXd& slopes) {
  constexpr double rounding = 1e-6;  // of a slope
  Landmarks variance = Landmarks::Zero();
  for (const ParameterInfo& info : all_parameters()) {
    std::vector<double> values;
    Landmarks slope = Landmarks::Zero();
    bool in_group = false;
    for (std::size_t k = 0; k < problem.unknowns.size(); ++k) {
      const Unknown& unknown = problem.unknowns[k];
      if (unknown.info != &info) continue;
      in_group = in_group || std::ranges::count(unknown.specimens, s) > 0;
      const auto index = static_cast<Eigen::Index>(k);
      values.push_back(answer.best.point[index]);
      const auto active = std::ranges::find(answer.active, index);
      if (active != answer.active.end())
        slope += slopes.col(active - answer.active.begin()).array();
    }
    if (in_group || values.empty()) continue;
    const Statistics groups = statistics_of(values);
    const double spread = groups.n > 1
                              ? std::pow(groups.sd, 2) + std::pow(groups.standard_error(), 2)
                              : std::numeric_limits<double>::infinity();
    variance += (slope.abs() > rounding).select(slope.square() * spread, 0.0);
  }
  return variance;
}

// (F24) What the errors of the fit make of the prediction of a specimen that it did not see.
Landmarks error_of_parameters(const FitProblem& problem, SimulationBatch& batch,
                              const Answer& answer, std::size_t s) {
  const Specimen& specimen = problem.study.specimens[s];
  if (specimen.use == Use::fit || answer.slopes.failed || !problem.targets[s].usable)
    return Landmarks::Zero();
  const Eigen::MatrixXd slopes = specimen_slopes(batch, problem, answer, specimen, s);
  if (slopes.size() == 0) return Landmarks::Zero();
  const Landmarks of_fit = (slopes * answer.uncertainty.follow).rowwise().norm();
  return (of_fit.square() + variance_of_groups(problem, answer, s, slopes)).sqrt();
}

// (F6) As the weights have it, of a specimen that the fit did not see at the answer.
Landmarks error_of_scatter(const FitProblem& problem, SimulationBatch& batch, const Answer& answer,
                           std::size_t s, const Prediction& here) {
  if (answer.weights.scatter.empty()) return Landmarks::Zero();
  return problem.study.specimens[s].use == Use::fit
             ? answer.weights.scatter[s]
             : porosity_error(problem, batch, answer.best.point, s, here);
}

// Shares of the cost, of which specimens kept for validation are no part.
void set_shares(std::vector<SpecimenResult>& specimens) {
  const double sum = 2.0 * cost_of(specimens, 0.0);
  for (auto& specimen : specimens)
    for (auto& term : specimen.terms)
      if (specimen.use == Use::fit && sum > 0.0) term.share = std::pow(term.residual, 2) / sum;
}

}  // namespace

double cost_of(const std::vector<SpecimenResult>& specimens, double otherwise) {
  double sum = 0.0;
  bool any = false;
  for (const auto& specimen : specimens)
    for (const auto& term : specimen.terms) {
      if (specimen.use != Use::fit) continue;
      any = true;
      sum += 0.5 * term.residual * term.residual;
    }
  return any ? sum : otherwise;
}

std::vector<SpecimenResult> specimens_of(const FitProblem& problem, SimulationBatch& batch,
                                         const Answer& answer) {
  const auto simulated = simulate_all(problem, batch, answer);
  const auto spread = spread_of(problem, simulated);
  std::vector<SpecimenResult> results;
  for (std::size_t s = 0; s < simulated.size(); ++s) {
    SpecimenResult& result = results.emplace_back(result_of(problem, s, simulated[s]));
    result.terms =
        terms_of(simulated[s].prediction, problem.targets[s],
                 {.replicates = spread[s],
                  .scatter = error_of_scatter(problem, batch, answer, s, simulated[s].prediction),
                  .specimens = answer.weights.specimen,
                  .parameters = error_of_parameters(problem, batch, answer, s)});
    result.residual = standardised(result.terms);
  }
  set_shares(results);
  return results;
}

}  // namespace havers::calib
