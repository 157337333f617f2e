// The simulator of havers::sim, as calibrations use it.
#include <numeric>
#include <optional>
#include <utility>

#include "calib/fit/calibrate.hpp"
#include "calib/fit/search.hpp"
#include "calib/fit/simulation_batch.hpp"
#include "sim/simulate.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {
namespace {

// A dynamic run records thousands of rows; a store keeps what a figure shows.
constexpr std::size_t rows_kept = 1000;

}  // namespace

std::optional<Response> response_of(const sim::Simulation& run) {
  if (run.status == sim::SimulationStatus::cancelled) return std::nullopt;
  Response response;
  // What falls apart before it is pulled is nobody's test.
  const bool severed = run.status == sim::SimulationStatus::severed;
  response.failed = severed || !run.trusted();
  response.broke = run.status == sim::SimulationStatus::broken;
  // What helps stands behind a semicolon, which the verdict looks for.
  response.why = severed ? sim::explain(run.status) +
                               "; with fewer of them or more fibres a chain is left that bears"
                 : response.failed ? run.why_not_trusted()
                                   : run.reservation(true);
  response.modulus = run.has_modulus_of_a_shock() ? 0.0 : run.modulus;
  response.strength = run.strength_without_ringing();
  response.failure_strain = run.failure_strain;
  const std::size_t stride = run.curve.size() / rows_kept + 1;
  for (std::size_t i = 0; i < run.curve.size(); ++i) {
    const auto& row = run.curve[i];
    // The rows of the strength and of the end are kept whatever the stride.
    const bool last = i + 1 == run.curve.size();
    if (i % stride != 0 && !last && row.strain != run.failure_strain) continue;
    response.strain.push_back(row.strain);
    response.stress.push_back(row.stress_right);
  }
  return response;
}

Simulator fibre_model(const sim::StopAsked& stop_asked) {
  return {.run =
              [stop_asked](const sim::Scene& scene) {
                return response_of(sim::simulate(scene, {}, stop_asked));
              },
          .quasi_static =
              [](const sim::Scene& scene) {
                return sim::choose_regime(scene).regime == sim::Regime::quasi_static;
              }};
}

std::size_t costly_unknowns(const Study& study) {
  const FitProblem problem = make_problem(study);
  Active all(problem.unknowns.size());
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  // This batch is asked only for the keys of scenes: nothing is simulated.
  const SimulationBatch batch(fibre_model(), nullptr, 1);
  return split_by_cost(problem, batch, start_point(problem.unknowns), all).costly.size();
}

CalibrationResult calibrate(const Study& study, EvaluationStore* store,
                            const CalibrationObserver& observer, const sim::StopAsked& stop_asked) {
  Simulator model = fibre_model(stop_asked);
  // A run that is a shock has a strength, which is enough for a sweep; a fit needs the modulus too.
  model.run = [run = std::move(model.run)](const sim::Scene& scene) {
    std::optional<Response> response = run(scene);
    if (response && !response->failed && response->modulus == 0.0) {
      response->failed = true;
      response->why =
          "the modulus is that of a shock: waves of the start cross the specimen less than twice "
          "while it is measured";
    }
    return response;
  };
  return calibrate_with(model, study, store, observer);
}

}  // namespace havers::calib
