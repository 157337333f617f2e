// One step of a wall through havers and through Siconos, side by side: CPU time at the same error
// of the joint forces. Usage: peers [LAYERS FIBRES]
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "sim/bench/watched_run.hpp"
#include "sim/contact/active_set.hpp"
#include "tests/benchmark/siconos_problem.hpp"
#include "tests/support/bonded_wall.hpp"

namespace havers::test {
namespace {

using Eigen::VectorXd;

double relative_error(const VectorXd& reactions, const VectorXd& exact) {
  return (reactions - exact).norm() / exact.norm();
}

void print_row(const std::string& problem, const std::string& solver, double cpu, double error,
               int iterations) {
  fmt::print("{:<28}{:<26}{:>12.3f}{:>12.1e}{:>12}\n", problem, solver, 1e3 * cpu, error,
             iterations);
  std::fflush(stdout);
}

// The second solve of a step, as in a run: the factor and the influence columns are there.
struct DirectAnswer {
  sim::JointStepResult result;
  double cpu = 0.0;
};

DirectAnswer solve_directly(const WallStep& wall) {
  constexpr int repeats = 20;
  sim::ActiveSetSolver solver(wall.bodies);
  DirectAnswer answer{solver.solve(wall.step)};
  const std::clock_t begin = std::clock();
  for (int i = 0; i < repeats; ++i) answer.result = solver.solve(wall.step);
  answer.cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / repeats;
  return answer;
}

void compare(const sim::Scene& scene, double strain, double size, const std::string& name) {
  const WallStep wall(scene, strain, step_of(scene, size));
  const std::string problem = fmt::format("{}, h c/L = {:g}", name, size);
  const DirectAnswer direct = solve_directly(wall);
  const VectorXd exact = strain < sim::first_break_by_uniform_stress(scene)
                             ? sim::bonded_forces_at(scene, strain)
                             : direct.result.reactions;
  print_row(problem, fmt::format("havers, residual {:.0e}", direct.result.residual), direct.cpu,
            relative_error(direct.result.reactions, exact),
            static_cast<int>(direct.result.iterations));
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const SiconosAnswer sweeps =
        solve_with_siconos(wall.bodies, wall.step, SiconosSolver::nsgs, tolerance, 100000);
    print_row(problem,
              fmt::format("Siconos NSGS {:g}{}", tolerance, sweeps.converged ? "" : " (stopped)"),
              sweeps.cpu, relative_error(sweeps.reactions, exact), sweeps.iterations);
  }
  const SiconosAnswer newton =
      solve_with_siconos(wall.bodies, wall.step, SiconosSolver::newton, 1e-8, 200);
  print_row(problem, fmt::format("Siconos Newton{}", newton.converged ? "" : " (no answer)"),
            newton.cpu, relative_error(newton.reactions, exact), newton.iterations);
}

// Strain at which about one joint in a hundred has left its cone.
double strain_of_one_in_a_hundred(const sim::Scene& scene) {
  const sim::Assembly assembly = sim::build_assembly(scene.assembly, scene.loading.lateral);
  const std::vector<sim::Threshold> thresholds = sim::draw_thresholds(scene, assembly);
  std::vector<double> strains;
  for (std::size_t j = 0; j < thresholds.size(); ++j)
    if (assembly.joints[j].kind == sim::JointKind::head_tail)
      strains.push_back(thresholds[j].normal / (scene.material.young * assembly.joints[j].length));
  const auto place = static_cast<std::ptrdiff_t>(thresholds.size() / 100);
  std::nth_element(strains.begin(), strains.begin() + place, strains.end());
  return strains[static_cast<std::size_t>(place)];
}

}  // namespace
}  // namespace havers::test

int main(int argc, char** argv) {
  using namespace havers;
  const int layers = argc > 2 ? std::atoi(argv[1]) : 30,
            fibres = argc > 2 ? std::atoi(argv[2]) : 21;
  const sim::Scene scene = test::wall(layers, fibres, sim::Lateral::free);
  fmt::print("{} x {} fibres, free sides\n{:<28}{:<26}{:>12}{:>12}{:>12}\n", fibres, layers,
             "problem", "solver", "CPU (ms)", "error", "iterations");
  const double bonded = 0.9 * sim::first_break_by_uniform_stress(scene);
  const double breaking = test::strain_of_one_in_a_hundred(scene);
  for (const double size : {1.0, 3.0}) {
    test::compare(scene, bonded, size, "bonded");
    test::compare(scene, breaking, size, "1 % breaking");
  }
  return 0;
}
