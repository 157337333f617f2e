#include "sim/quasi_static/intact_structure.hpp"

#include <cmath>
#include <list>
#include <mutex>
#include <tuple>
#include <utility>

#include "sim/contact/joint_step.hpp"

namespace havers::sim {
namespace {

constexpr std::size_t kept = 8;

// A trace of inertia, that of h c/L = 1e6, holds what hangs on a single joint or floats, and nothing else feels it.
Shift quasi_static_shift(const AssemblyOptions& options) {
  return {1e-12 / (options.fibre_length * options.fibre_length), 1.0};
}

Material unit_material(const Material& material) {
  Material unit = material;
  unit.young = 1.0;
  unit.density = 1.0;
  return unit;
}

}  // namespace

IntactStructure::IntactStructure(const AssemblyOptions& options, const Loading& loading, const Material& material,
                                 bool share)
    : assembly(build_assembly(options, loading.lateral)),
      bodies(assembly, unit_material(material), quasi_static_shift(options), share),
      structure(bodies) {
  if (!structure.ok()) return;
  const StructureResponse response = stretch(Eigen::VectorXd::Zero(2 * structure.joints()));
  reactions = response.reactions;
  force = end_force(response.displacements, reactions);
}

StructureResponse IntactStructure::stretch(const Eigen::VectorXd& gaps) const {
  StructureLoads loads{Eigen::VectorXd::Zero(bodies.dofs()), Eigen::VectorXd::Zero(bodies.dofs()), gaps};
  for (const int node : assembly.right) loads.prescribed(2 * node) = assembly.width;
  return structure.solve(loads);
}

double IntactStructure::end_force(const Eigen::VectorXd& q, const Eigen::VectorXd& r) const {
  const Eigen::VectorXd forces = bodies.stiffness_times(q) - joint_forces_on_nodes(bodies, r);
  double sum = 0.0;
  for (const int node : assembly.right) sum += forces(2 * node);
  return sum;
}

std::shared_ptr<const IntactStructure> intact_structure(const Scene& scene) {
  const AssemblyOptions& a = scene.assembly;
  using Key = std::tuple<int, int, double, double, double, Lateral, double, Plane, bool>;
  const Key key{a.layers, a.fibres, a.fibre_length, a.fibre_height, a.orientation, scene.loading.lateral,
                scene.material.poisson, scene.material.plane, scene.solver.leave_out};
  static std::mutex mutex;
  static std::list<std::pair<Key, std::shared_ptr<const IntactStructure>>> recent;

  const std::scoped_lock lock(mutex);
  for (auto entry = recent.begin(); entry != recent.end(); ++entry)
    if (entry->first == key) {
      recent.splice(recent.begin(), recent, entry);
      return entry->second;
    }
  recent.emplace_front(
      key, std::make_shared<IntactStructure>(a, scene.loading, scene.material, scene.solver.leave_out));
  if (recent.size() > kept) recent.pop_back();
  return recent.front().second;
}

}  // namespace havers::sim
