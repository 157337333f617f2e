// CPU time of the simulator's parts and of whole runs, with the error of what they computed: that
// is found outside of the time.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "sim/bench/watched_run.hpp"
#include "sim/contact/active_set.hpp"
#include "sim/memory.hpp"
#include "sim/quasi_static/breaking_sequence.hpp"
#include "tests/support/bonded_wall.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// Layers of 30 k, fibres of 21 k.
Scene contract_wall(const benchmark::State& state) {
  const auto k = static_cast<int>(state.range(0));
  return test::wall(30 * k, 21 * k);
}

double relative(const Eigen::VectorXd& error, const Eigen::VectorXd& exact) {
  return error.norm() / exact.norm();
}

void BondedStep(benchmark::State& state) {
  const Scene scene = contract_wall(state);
  const double strain = 0.5 * first_break_by_uniform_stress(scene);
  const test::WallStep wall(scene, strain, test::step_of(scene, 1.0));
  ActiveSetSolver solver(wall.bodies);
  JointStepResult result;
  for (auto _ : state) benchmark::DoNotOptimize(result = solver.solve(wall.step));
  const Eigen::VectorXd exact = bonded_forces_at(scene, strain);  // (M1)
  state.counters["force_error"] = relative(result.reactions - exact, exact);
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

// Beside a run that is computed with more care: as many joints break in its order, and after the
// last of them all forces err by this.
void report_error(benchmark::State& state, const Scene& scene, const Scene& careful) {
  constexpr double no_limit = 1e9;
  const WatchedRun run = watch(scene, {.time_limit = no_limit}, {});
  const WatchedRun reference = watch(careful, {.time_limit = no_limit}, {});
  state.counters["same_breaks"] = static_cast<double>(same_breaks(run, reference));
  state.counters["force_error"] = force_error(run, reference);
}

// Nothing is left out, so that rounding differs, but the end of the avalanche: that takes minutes.
void report_error_in_limit(benchmark::State& state, const Scene& scene) {
  Scene careful = scene;
  careful.solver.leave_out = false;
  careful.loading.end_fraction = end_fraction_used(scene);
  report_error(state, scene, careful);
}

void DynamicToFailure(benchmark::State& state) {
  Scene scene = contract_wall(state);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 2e-8;
  Simulation run;
  for (auto _ : state) run = simulate(scene);
  report(state, run);
  Scene careful = scene;
  careful.solver.tolerance *= 1e-3;  // minutes, where nothing is left out
  report_error(state, scene, careful);
}
BENCHMARK(DynamicToFailure)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

Scene quasi_static_wall(const benchmark::State& state) {
  Scene scene = contract_wall(state);
  scene.assembly.orientation = static_cast<double>(state.range(1)) * test::degree;
  scene.solver.regime = Regime::quasi_static;
  return scene;
}

void walls_and_angles(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"k", "degrees"})->Unit(benchmark::kMillisecond);
  for (const int degrees : {0, 45, 90})
    for (const int k : {1, 2, 4}) bench->Args({k, degrees});
}

// Poisson's ratio differs from run to run in a digit without meaning, so that no factor is shared.
void QuasiStaticFirstSeed(benchmark::State& state) {
  static int runs = 0;
  Scene scene = quasi_static_wall(state);
  const double poisson = scene.material.poisson;
  Simulation run;
  for (auto _ : state) {
    scene.material.poisson = poisson + 1e-12 * ++runs;
    run = simulate(scene);
  }
  report(state, run);
  report_error_in_limit(state, scene);
}
BENCHMARK(QuasiStaticFirstSeed)->Apply(walls_and_angles);

// 63 000 fibres. The peak is that of the process: it is this run's where no other has been before.
void QuasiStaticLargestWall(benchmark::State& state) {
  const Scene scene = quasi_static_wall(state);
  Simulation run;
  for (auto _ : state) run = simulate(scene);
  report(state, run);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}
BENCHMARK(QuasiStaticLargestWall)
    ->ArgNames({"k", "degrees"})
    ->Args({10, 90})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

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
  report_error_in_limit(state, scene);
  report_time_of_an_event(state, events);
}
BENCHMARK(QuasiStaticNewSeed)->Apply(walls_and_angles)->Iterations(20);

// The replicates of a fit, again at another threshold: what the second time makes is there.
void QuasiStaticSeedAgain(benchmark::State& state) {
  constexpr std::uint64_t replicates = 8;
  Scene scene = quasi_static_wall(state);
  Simulation run;
  for (std::uint64_t i = 0; i < 2 * replicates; ++i) {
    scene.joints.seed = 1 + i % replicates;
    run = simulate(scene);
  }
  long events = 0;
  for (auto _ : state) {
    scene.joints.seed = 1 + scene.joints.seed % replicates;
    scene.joints.head_tail *= 1.0 + 1e-6;
    run = simulate(scene);
    events += run.steps;
  }
  report(state, run);
  report_error_in_limit(state, scene);
  report_time_of_an_event(state, events);
}
BENCHMARK(QuasiStaticSeedAgain)->Apply(walls_and_angles)->Iterations(24);

}  // namespace
}  // namespace havers::sim

int main(int argc, char** argv) {
  havers::sim::keep_freed_memory();  // as havers does
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
