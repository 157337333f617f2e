// From a point to residuals: the scenes of each specimen there, all simulated in one batch, their
// landmarks less the measured ones (F7), over standard deviations by source (F6).
#include "calib/fit/fit_problem.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "calib/fit/bound.hpp"
#include "calib/fit/replicate_spread.hpp"
#include "sim/quasi_static/breaking_sequence.hpp"
#include "sim/simulate.hpp"

namespace havers::calib {
namespace {

// Step of the scatter for the slope that weighs its standard error.
constexpr double scatter_step = 0.05;

bool searched(const FitProblem& problem, std::string_view name) {
  return std::ranges::any_of(problem.unknowns,
                             [&](const Unknown& u) { return u.info->name == name; });
}

// The post-peak drop is seen by a run that goes on until the stress has fallen; in the quasi-static
// limit the rest of an avalanche is left out otherwise.
void follow_fall(const std::vector<std::string>& terms, sim::Scene& scene) {
  if (std::ranges::find(terms, name_of(post_peak)) == terms.end()) return;
  const bool in_limit = sim::choose_regime(scene).regime == sim::Regime::quasi_static;
  const double end = in_limit ? sim::end_fraction_used(scene) : scene.loading.end_fraction;
  if (end <= fallen_part) return;
  scene.loading.end_fraction = fallen_part;
  if (in_limit) scene.solver.leave_out = false;
}

// Laws of porosity may be searched too: the specimen's scatter and modulus then change with the
// point.
SpecimenModel model_at(const FitProblem& problem, const Point& point, std::size_t specimen) {
  PorosityOptions laws = problem.study.porosity;
  for (const auto& info : all_parameters())
    if (const auto value = value_at(problem.unknowns, point, info, specimen))
      apply(laws, info.name, *value);
  return model_of(problem.study, specimen, laws);
}

// Parameters are applied in the order of their table, as some keep what others have set
// (calib/study).
sim::Scene scene_at(const FitProblem& problem, const Point& point, std::size_t specimen) {
  const SpecimenModel model = model_at(problem, point, specimen);
  sim::Scene scene = model.scene;
  for (const auto& info : all_parameters())
    if (const auto value = value_at(problem.unknowns, point, info, specimen))
      apply(scene, info.name, *value);
  // (K4) A searched modulus is that of bone without pores.
  scene.material.young *= model.modulus_factor;
  follow_fall(problem.study.calibrate.terms, scene);
  return scene;
}

// (F2) The study's seed, which all points have in common, or one of this point's own: a hash of
// its coordinates, so that a point asked for again has it again.
std::uint64_t seed_at(const FitProblem& problem, const Point& point) {
  const auto& options = problem.study.calibrate;
  std::uint64_t seed = options.seed;
  if (options.common_seeds) return seed;
  for (const double z : point)
    seed = replicate_seed(seed ^ std::bit_cast<std::uint64_t>(z), "point", 0);
  return seed;
}

std::vector<sim::Scene> replicates_of(const Specimen& specimen, std::uint64_t seed,
                                      const sim::Scene& scene, int replicates) {
  std::vector<sim::Scene> scenes(static_cast<std::size_t>(replicates), scene);
  for (int i = 0; i < replicates; ++i)
    scenes[static_cast<std::size_t>(i)].joints.seed = replicate_seed(seed, specimen.id, i);
  return scenes;
}

}  // namespace

FitProblem make_problem(const Study& study) {
  FitProblem problem{.study = study, .unknowns = unknowns_of(study)};
  for (std::size_t s = 0; s < study.specimens.size(); ++s) {
    problem.models.push_back(model_of(study, s));
    problem.targets.push_back(target_of(study.specimens[s], study.calibrate.terms));
    if (study.specimens[s].use == Use::fit && problem.targets.back().usable)
      problem.fitted.push_back(s);
  }
  std::ranges::sort(problem.fitted, {}, [&](std::size_t s) { return study.specimens[s].id; });
  return problem;
}

std::vector<sim::Scene> replicate_scenes(const FitProblem& problem, const Point& point,
                                         std::size_t specimen, int replicates) {
  return replicates_of(problem.study.specimens[specimen], seed_at(problem, point),
                       scene_at(problem, point, specimen), replicates);
}

std::vector<Evaluation> predict(const FitProblem& problem, SimulationBatch& batch,
                                const std::vector<Point>& points, int replicates) {
  // Point by point, specimen by specimen, replicate by replicate.
  std::vector<sim::Scene> scenes;
  for (const auto& point : points)
    for (const std::size_t s : problem.fitted)
      std::ranges::move(replicate_scenes(problem, point, s, replicates),
                        std::back_inserter(scenes));
  const auto responses = batch.run(scenes);

  const auto count = static_cast<std::size_t>(replicates);
  std::vector<Evaluation> evaluations(points.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& evaluation = evaluations[i];
    evaluation.point = points[i];
    for (std::size_t f = 0; f < problem.fitted.size(); ++f, next += count)
      evaluation.predictions.push_back(summarise(std::span(responses).subspan(next, count)));
    evaluation.failed = std::ranges::any_of(evaluation.predictions, &Prediction::failed_point);
  }
  return evaluations;
}

bool has_bound(const Prediction& prediction, const Target& target) {
  return target.censored && target.present[strength] && !prediction.censored;
}

Landmarks difference(const Prediction& prediction, const Target& target) {
  Landmarks result = prediction.mean - target.value;
  // What did not break gives a bound on the strength, and no landmark of a break.
  if (prediction.censored) {
    // Where both are lower bounds, neither contradicts the other.
    result[strength] = target.censored ? 0.0 : std::max(result[strength], 0.0);
    result.tail<4>() = 0.0;
  }
  return target.present.select(result, 0.0);
}

Landmarks residuals_of(const Prediction& prediction, const Target& target, const Landmarks& sd) {
  Landmarks residuals = difference(prediction, target) / sd;
  if (has_bound(prediction, target)) residuals[strength] = residual_of_bound(residuals[strength]);
  return residuals;
}

Landmarks slopes_of_residuals(const Prediction& prediction, const Target& target,
                              const Landmarks& sd) {
  Landmarks slopes = tells(prediction, target).cast<double>();
  if (has_bound(prediction, target))
    slopes[strength] = slope_of_bound(difference(prediction, target)[strength] / sd[strength]);
  return slopes;
}

Eigen::Array<bool, landmark_count, 1> tells(const Prediction& prediction, const Target& target) {
  Eigen::Array<bool, landmark_count, 1> told = target.present;
  if (prediction.censored) {
    // Simulations that did not break give a lower bound, which tells something only where it is
    // above the measured strength.
    told[strength] = told[strength] && difference(prediction, target)[strength] > 0.0;
    told.tail<4>() = false;
  }
  told[strength] = told[strength] && !target.censored;
  return told;
}

Landmarks residuals_told(const FitProblem& problem, const Evaluation& at) {
  Landmarks count = Landmarks::Zero();
  for (std::size_t f = 0; f < problem.fitted.size(); ++f)
    count += tells(at.predictions[f], problem.targets[problem.fitted[f]]).cast<double>();
  return count;
}

void score(const FitProblem& problem, const Weights& weights, Evaluation& evaluation) {
  evaluation.cost = std::numeric_limits<double>::infinity();
  if (evaluation.failed) return;
  evaluation.residuals.resize(landmark_count * static_cast<Eigen::Index>(problem.fitted.size()));
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    evaluation.residuals.segment<landmark_count>(first_row(f)) =
        residuals_of(evaluation.predictions[f], problem.targets[s], weights.sd[s]);
  }
  const double cost = 0.5 * evaluation.residuals.squaredNorm();
  // A landmark without a number, as log E where the modulus is not known, fails the point.
  evaluation.failed = !std::isfinite(cost);
  if (!evaluation.failed) evaluation.cost = cost;
}

std::set<double> one_sided_orientations(const FitProblem& problem, const Evaluation& at) {
  constexpr double least_told = 0.2;  // residual of a bound that one in fifty breaks below
  std::set<double> orientations;
  if (at.residuals.size() == 0) return orientations;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const Eigen::Index row = first_row(f) + strength;
    if (has_bound(at.predictions[f], problem.targets[s]) && at.residuals[row] < -least_told)
      orientations.insert(problem.study.specimens[s].orientation);
  }
  return orientations;
}

Landmarks porosity_error(const FitProblem& problem, SimulationBatch& batch, const Point& point,
                         std::size_t specimen, const Prediction& here) {
  Landmarks variance = Landmarks::Zero();
  if (!problem.targets[specimen].usable) return variance;
  const SpecimenModel model = model_at(problem, point, specimen);
  // (error · ∂y/∂number)² by a one-sided difference with the seeds of `here`; 0 where the specimen
  // cannot be simulated there.
  const auto add = [&](double error, double sim::JointOptions::*number, double step) {
    sim::Scene scene = scene_at(problem, point, specimen);
    scene.joints.*number += step;
    const auto moved = summarise(
        batch.run(replicates_of(problem.study.specimens[specimen], seed_at(problem, point), scene,
                                static_cast<int>(here.replicates.size()))));
    if (!moved.failed_point()) variance += (error * (moved.mean - here.mean) / step).square();
  };
  variance[modulus] = std::pow(model.modulus_standard_error, 2);
  // Steps lead away from the nearer end of what d, or the missing part, may be.
  if (model.scatter_standard_error > 0.0 && !searched(problem, "scatter"))
    add(model.scatter_standard_error, &sim::JointOptions::scatter,
        scene_at(problem, point, specimen).joints.scatter < 1.0 ? scatter_step : -scatter_step);
  if (const double error = model.missing_standard_error; error > 0.0)
    add(error, &sim::JointOptions::missing, model.scene.joints.missing < 0.5 ? error : -error);
  return variance.sqrt();
}

Landmarks variance_if_alike(const Weights& weights, std::size_t specimen) {
  return weights.sd[specimen].square() - weights.specimen.square();
}

int all_replicates(const CalibrateOptions& options) {
  constexpr int before_need = 8;  // until it is known how many are needed (F17)
  return options.replicates == replicates_by_need ? before_need : options.replicates;
}

Weights weigh(const FitProblem& problem, const Evaluation& at, std::vector<Landmarks> scatter,
              const Landmarks& specimen) {
  assert(!at.failed);
  const std::vector<Landmarks> zero(problem.models.size(), Landmarks(Landmarks::Zero()));
  Weights weights{
      .replicates = zero, .scatter = std::move(scatter), .specimen = specimen, .sd = zero};
  std::vector<Replicated> replicated;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f)
    replicated.push_back(replicated_of(problem.study.specimens[problem.fitted[f]].orientation,
                                       scene_at(problem, at.point, problem.fitted[f]).joints,
                                       at.predictions[f]));
  const auto spread = replicate_spread(replicated);
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    // The specimen is one draw of the model, the prediction a mean of n.
    weights.replicates[s] = spread[f] * std::sqrt(1.0 + 1.0 / at.predictions[f].usable);
    weights.sd[s] = (problem.targets[s].noise.square() + weights.replicates[s].square() +
                     weights.scatter[s].square() + specimen.square())
                        .sqrt();
  }
  return weights;
}

}  // namespace havers::calib
