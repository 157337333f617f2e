// The same seeds in the quasi-static limit and in time steps (F21). Replicates of the fit are in
// the batch's memory: the runs in time are what this costs.
#include "calib/fit/confirmation.hpp"

#include <algorithm>
#include <map>

#include "sim/simulate.hpp"

namespace havers::calib {
namespace {

/// One replicate as it was fitted, and the same in time.
struct RunPair {
  Confirmation names;
  sim::Scene still, moving;
};

// Pairs are spread evenly over the fitted specimens; one that is taken again gives its next
// replicate.
std::vector<RunPair> pairs_of(const FitProblem& problem, const Answer& answer) {
  std::vector<RunPair> pairs;
  std::map<std::size_t, int> taken;
  const auto runs = static_cast<std::size_t>(problem.study.calibrate.confirm);
  for (std::size_t run = 0; run < runs; ++run) {
    const std::size_t s = problem.fitted[run * problem.fitted.size() / runs];
    RunPair pair;
    pair.still = replicate_scenes(problem, answer.best.point, s, ++taken[s]).back();
    const auto choice = sim::choose_regime(pair.still);
    if (choice.regime != sim::Regime::quasi_static) continue;  // it was simulated in time
    pair.moving = pair.still;
    // The inertia number (M12) is proportional to the rate: this is the fastest that counts as
    // quasi-static.
    pair.moving.loading.strain_rate *= sim::quasi_static_below / choice.inertia_number;
    pair.moving.solver.regime = sim::Regime::dynamic;
    // As the study has it: where the fall is followed (F4) the replicate in the limit leaves
    // nothing out, which in time would take long and is not needed.
    pair.moving.solver.leave_out = problem.study.model.solver.leave_out;
    pair.names = {.specimen = problem.study.specimens[s].id,
                  .seed = pair.still.joints.seed,
                  .strain_rate = pair.moving.loading.strain_rate};
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace

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
    one.strength_in_time = in_time[i].strength;
    one.peak_in_time = *std::ranges::max_element(in_time[i].stress);
    one.failure_strain_limit = limit[i].failure_strain;
    one.failure_strain_in_time = in_time[i].failure_strain;
  }
  return confirmations;
}

}  // namespace havers::calib
