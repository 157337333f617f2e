#include "sim/bench/watched_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "sim/joint/cohesive_cone.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/quasi_static/intact_structure.hpp"
#include "sim/stopwatch.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Of joints at breaks, that a run keeps: 16 MiB.
constexpr std::size_t most_forces = std::size_t{1} << 20U;

VectorXd forces_of(const std::vector<JointOutcome>& joints) {
  VectorXd forces(2 * static_cast<Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j)
    forces.segment<2>(static_cast<Index>(2 * j)) << joints[j].reaction_normal,
        joints[j].reaction_tangent;
  return forces;
}

// Takes down what an observer sees, row by row.
class Watcher {
 public:
  Watcher(double bonded_strain, WatchedRun& run) : bonded_strain_(bonded_strain), run_(&run) {}

  void record(const Progress& progress) {
    if (progress.row <= row_) begin_again();
    row_ = progress.row;
    const double strain = progress.point.strain;
    const bool bonded = run_->bonded_forces.size() == 0 && broken_ == 0;  // before this row
    // Joints are asked for only in the rows that need them.
    if (!bonded && progress.point.broken_joints == broken_) return;
    broken_ = progress.point.broken_joints;
    const std::vector<JointOutcome> joints = progress.joints();
    if (bonded) {
      const VectorXd forces = forces_of(joints);
      if (last_.forces.size() == 0) last_.forces = VectorXd::Zero(forces.size());
      before_ = std::exchange(last_, {strain, forces});
      if (broken_ == 0 && strain >= bonded_strain_) run_->bonded_forces = forces_on_line();
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const JointOutcome& joint = joints[j];
      // Joints that break in the same row stand in the order of their index.
      if (!joint.broke() || !seen_.insert(j).second) continue;
      run_->order.push_back(static_cast<int>(j));
      if (run_->forces_at_break.size() * joints.size() < most_forces)
        run_->forces_at_break.push_back(forces_of(joints));
    }
  }

  /// At the strain asked for, through the last two rows, the second that of the first break at
  /// most.
  [[nodiscard]] VectorXd forces_on_line() const {
    if (before_.forces.size() == 0) return {};
    if (bonded_strain_ < before_.strain || bonded_strain_ > last_.strain) return {};
    const double w = (bonded_strain_ - before_.strain) / (last_.strain - before_.strain);
    return (1.0 - w) * before_.forces + w * last_.forces;
  }

 private:
  struct Row {
    double strain = 0.0;
    VectorXd forces;
  };

  // Another run: a chosen step is halved, or one in the limit done again with care.
  void begin_again() {
    *run_ = {};
    *this = Watcher(bonded_strain_, *run_);
  }

  double bonded_strain_;
  std::size_t row_ = 0;
  int broken_ = 0;
  Row before_, last_;  // before the first row everything is 0
  std::set<std::size_t> seen_;
  WatchedRun* run_;
};

// The limit shows no row before the first break; until then forces are proportional to the strain.
VectorXd bonded_forces_in_limit(const Scene& scene, double strain) {
  if (some_are_missing(scene.joints)) return {};
  return scene.material.young * strain * intact_structure(scene)->answer().reactions;
}

}  // namespace

WatchedRun watch(const Scene& scene, const WatchOptions& options, const StopAsked& stop_asked) {
  WatchedRun run;
  Watcher watcher(options.bonded_strain, run);
  const Stopwatch stopwatch;
  bool out_of_time = false;
  run.simulation = simulate(
      scene, [&](const Progress& progress) { watcher.record(progress); },
      [&] {
        out_of_time = stopwatch.wall_seconds() > options.time_limit;
        return out_of_time || stop_is_asked(stop_asked);
      });
  run.out_of_time = out_of_time;
  run.wall = stopwatch.wall_seconds();
  run.cpu = stopwatch.cpu_seconds();
  // The motion that is leapt over is uniform, and what breaks then bears what it bears in it.
  if (run.bonded_forces.size() == 0 && run.simulation.leapt_strain > 0.0)
    run.bonded_forces = watcher.forces_on_line();
  if (run.simulation.regime == Regime::quasi_static)
    run.bonded_forces = bonded_forces_in_limit(scene, options.bonded_strain);
  return run;
}

std::size_t same_breaks(const WatchedRun& run, const WatchedRun& reference) {
  const auto parting = std::ranges::mismatch(run.order, reference.order);
  return static_cast<std::size_t>(parting.in1 - run.order.begin());
}

double force_error(const WatchedRun& run, const WatchedRun& reference) {
  const std::size_t n = std::min(
      {same_breaks(run, reference), run.forces_at_break.size(), reference.forces_at_break.size()});
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  double largest = reference.bonded_forces.norm();
  for (std::size_t i = 0; i < n; ++i)
    largest = std::max(largest, reference.forces_at_break[i].norm());
  return (run.forces_at_break[n - 1] - reference.forces_at_break[n - 1]).norm() / largest;
}

namespace {

// Of the height or, across the load, of the width: the part that every second layer takes.
double share_of_second_layers(const AssemblyOptions& assembly) {
  if (assembly.orientation == 0.0) {
    const int seconds = assembly.layers / 2;
    return static_cast<double>(seconds) / assembly.layers;
  }
  // Turned by 90° layer −1 is the first in the specimen, and a second one; the last may be cut.
  const double layers = assembly.width() / assembly.fibre_height;
  const double pairs = std::floor(0.5 * layers);
  return (pairs + std::min(1.0, layers - 2.0 * pairs)) / layers;
}

}  // namespace

double bonded_modulus(const Scene& scene) {
  const Material& material = scene.material;
  const double second = share_of_second_layers(scene.assembly), first = 1.0 - second;
  const double contrast = material.layer_contrast;
  const bool along = scene.assembly.orientation == 0.0;
  // In parallel along the load, in series across it.
  const double mean = along ? first + second * contrast : 1.0 / (first + second / contrast);
  return mean * material.young * plane_stiffening(material);
}

VectorXd bonded_forces_at(const Scene& scene, double strain) {
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  VectorXd forces = uniform_stress_forces(assembly, strain * bonded_modulus(scene));
  if (scene.assembly.orientation != 0.0) return forces;
  // Layers share the strain there, not the stress.
  for (std::size_t j = 0; j < assembly.joints.size(); ++j) {  // flanks bear nothing
    const int layer = assembly.bodies[static_cast<std::size_t>(assembly.joints[j].body_a)].layer;
    forces.segment<2>(static_cast<Index>(2 * j)) *= young_of_layer(scene.material, layer) *
                                                    plane_stiffening(scene.material) /
                                                    bonded_modulus(scene);
  }
  return forces;
}

double first_break_by_uniform_stress(const Scene& scene) {
  const VectorXd forces = bonded_forces_at(scene, 1.0);
  const std::vector<Threshold> thresholds =
      draw_thresholds(scene, build_assembly(scene.assembly, scene.loading.lateral));
  // A joint that bears nothing but rounding never breaks.
  const double noise = forces.size() > 0 ? 1e-12 * forces.cwiseAbs().maxCoeff() : 0.0;
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < thresholds.size(); ++j) {
    if (is_missing(thresholds[j])) continue;
    first =
        std::min(first, strain_at_cone(of_joint(forces, j), intact_law(thresholds[j]), 1.0, noise));
  }
  return first;
}

}  // namespace havers::sim
