#include "calib/fit/confirmation.hpp"

#include <algorithm>
#include <cassert>
#include <map>

#include "sim/simulate.hpp"

namespace havers::calib {
namespace {

/// One replicate as it was fitted, and the same in time.
struct RunPair {
  Confirmation names;
  double transit = 0.0;  // strain that is imposed while a wave goes through the specimen
  sim::Scene still, moving;
};

std::vector<RunPair> pairs_of(const FitProblem& problem, const Answer& answer) {
  std::vector<RunPair> pairs;
  std::map<std::size_t, int> taken;
  const auto runs = static_cast<std::size_t>(problem.study.calibrate.confirm);
  for (std::size_t run = 0; run < runs; ++run) {
    const std::size_t s = problem.fitted[run * problem.fitted.size() / runs];
    RunPair pair;
    pair.still = replicate_scenes(problem, answer.best.point, s, ++taken[s]).back();
    pair.still.solver.regime = sim::Regime::automatic;
    const auto choice = sim::choose_regime(pair.still);
    if (choice.regime != sim::Regime::quasi_static) continue;  // it was simulated in time
    pair.moving = pair.still;
    pair.moving.loading.strain_rate *= sim::quasi_static_below / choice.inertia_number;
    pair.moving.solver.regime = sim::Regime::dynamic;
    pair.moving.solver.leave_out = problem.study.model.solver.leave_out;
    pair.transit =
        sim::quasi_static_below * pair.still.joints.head_tail / pair.still.material.young;
    pair.names = {.specimen = problem.study.specimens[s].id,
                  .seed = pair.still.joints.seed,
                  .strain_rate = pair.moving.loading.strain_rate};
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace

double largest_mean_stress(const Response& response, double span) {
  assert(span > 0.0);
  const auto &strain = response.strain, &stress = response.stress;
  std::vector<double> area{0.0};  // under the curve up to each row
  for (std::size_t i = 1; i < strain.size(); ++i)
    area.push_back(area.back() + 0.5 * (stress[i] + stress[i - 1]) * (strain[i] - strain[i - 1]));
  double largest = 0.0;
  for (std::size_t i = 1, left = 0; i < strain.size(); ++i) {
    const double begin = strain[i] - span;
    if (begin < strain.front()) continue;
    while (strain[left + 1] <= begin) ++left;
    const double part = (begin - strain[left]) / (strain[left + 1] - strain[left]);
    const double height = stress[left] + part * (stress[left + 1] - stress[left]);
    const double before = area[left] + 0.5 * (stress[left] + height) * (begin - strain[left]);
    largest = std::max(largest, (area[i] - before) / span);
  }
  return largest;
}

std::vector<Confirmation> confirm_in_time(SimulationBatch& batch, const FitProblem& problem,
                                          const Answer& answer) {
  const std::vector<RunPair> pairs = pairs_of(problem, answer);
  std::vector<sim::Scene> still, moving;
  for (const RunPair& pair : pairs) {
    still.push_back(pair.still);
    moving.push_back(pair.moving);
  }
  const auto limit = batch.run(still), in_time = batch.run(moving);
  std::vector<Confirmation> confirmations;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Confirmation& one = confirmations.emplace_back(pairs[i].names);
    one.failed = limit[i].failed || in_time[i].failed;
    if (one.failed) continue;
    one.strength_limit = limit[i].strength;
    one.strength_in_time = largest_mean_stress(in_time[i], pairs[i].transit);
    one.peak_in_time = in_time[i].strength;
    one.failure_strain_limit = limit[i].failure_strain;
    one.failure_strain_in_time = in_time[i].failure_strain;
  }
  return confirmations;
}

}  // namespace havers::calib
