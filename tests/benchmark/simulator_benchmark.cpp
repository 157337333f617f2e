// CPU time of the simulator's parts and of whole runs.
#include <benchmark/benchmark.h>

#include "sim/bench/watched_run.hpp"
#include "sim/contact/active_set.hpp"
#include "tests/support/bonded_wall.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// Layers of 30 k, fibres of 21 k.
Scene contract_wall(const benchmark::State& state) {
  const auto k = static_cast<int>(state.range(0));
  return test::wall(30 * k, 21 * k);
}

void BondedStep(benchmark::State& state) {
  const Scene scene = contract_wall(state);
  const test::WallStep wall(scene, 0.5 * first_break_by_uniform_stress(scene),
                            test::step_of(scene, 1.0));
  ActiveSetSolver solver(wall.bodies, 1000);
  JointStepResult result;
  for (auto _ : state) benchmark::DoNotOptimize(result = solver.solve(wall.step));
  state.counters["residual"] = result.residual;
}
BENCHMARK(BondedStep)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

// What a bonded step cannot do without.
void TriangularSolveOfItsFactor(benchmark::State& state) {
  const Scene scene = contract_wall(state);
  const test::WallStep wall(scene, 0.0, test::step_of(scene, 1.0));
  const Structure structure(wall.bodies);
  const Eigen::VectorXd load = Eigen::VectorXd::Ones(structure.factor().rows());
  for (auto _ : state) benchmark::DoNotOptimize(structure.factor().solve(load));
  state.counters["nonzeros"] = static_cast<double>(structure.factor().nonzeros());
}
BENCHMARK(TriangularSolveOfItsFactor)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

void report(benchmark::State& state, const Simulation& run) {
  state.counters["broken"] = run.broken_joints;
  state.counters["steps"] = run.steps;
  state.counters["residual"] = run.worst_residual;
  state.counters["energy_defect"] = run.energy_defect;
  if (!run.trusted()) state.SkipWithError("the run is not to be trusted");
}

void DynamicToFailure(benchmark::State& state) {
  Scene scene = contract_wall(state);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 2e-8;
  Simulation run;
  for (auto _ : state) run = simulate(scene);
  report(state, run);
}
BENCHMARK(DynamicToFailure)->Arg(1)->Unit(benchmark::kMillisecond);

Scene quasi_static_wall(const benchmark::State& state) {
  Scene scene = contract_wall(state);
  scene.assembly.orientation = static_cast<double>(state.range(1)) * test::degree;
  scene.solver.regime = Regime::quasi_static;
  return scene;
}

// At 0 degrees the joints that break are as many as the fibres, and 84 x 120 take a minute each.
void walls_and_angles(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"k", "degrees"})->Unit(benchmark::kMillisecond);
  for (const int degrees : {0, 45, 90})
    for (const int k : {1, 2, 4})
      if (k < 4 || degrees > 0) bench->Args({k, degrees});
}

// Poisson's ratio differs from run to run in a digit without meaning, so that no factor is shared.
void QuasiStaticFirstSeed(benchmark::State& state) {
  Scene scene = quasi_static_wall(state);
  Simulation run;
  for (auto _ : state) {
    scene.material.poisson += 1e-12;
    run = simulate(scene);
  }
  report(state, run);
}
BENCHMARK(QuasiStaticFirstSeed)->Apply(walls_and_angles);

// To compare with a triangular solve.
void report_time_of_an_event(benchmark::State& state, long events) {
  state.counters["event"] = {static_cast<double>(events),
                             benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

void QuasiStaticNewSeed(benchmark::State& state) {
  Scene scene = quasi_static_wall(state);
  Simulation run = simulate(scene);
  long events = 0;
  for (auto _ : state) {
    ++scene.joints.seed;
    run = simulate(scene);
    events += run.steps;
  }
  report(state, run);
  report_time_of_an_event(state, events);
}
BENCHMARK(QuasiStaticNewSeed)->Apply(walls_and_angles)->Iterations(20);

// The replicates of a fit, again at another threshold.
void QuasiStaticSeedAgain(benchmark::State& state) {
  constexpr std::uint64_t replicates = 8;
  Scene scene = quasi_static_wall(state);
  Simulation run;
  for (scene.joints.seed = 1; scene.joints.seed <= replicates; ++scene.joints.seed)
    run = simulate(scene);
  long events = 0;
  for (auto _ : state) {
    scene.joints.seed = scene.joints.seed % replicates + 1;
    scene.joints.head_tail *= 1.0 + 1e-6;
    run = simulate(scene);
    events += run.steps;
  }
  report(state, run);
  report_time_of_an_event(state, events);
}
BENCHMARK(QuasiStaticSeedAgain)->Apply(walls_and_angles)->Iterations(24);

}  // namespace
}  // namespace havers::sim
