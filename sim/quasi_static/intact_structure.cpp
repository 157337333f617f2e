#include "sim/quasi_static/intact_structure.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <list>
#include <tuple>
#include <utility>

#include "sim/contact/joint_step.hpp"

namespace havers::sim {
namespace {

constexpr std::size_t kept = 8;
// Part of the forces by which the solved ones may miss those of the uniform stress, which then
// stand in for them. Where they miss by more, self-stress is not determined (M10).
constexpr double known = 1e-6;
// Of reactions to jumps, all structures together.
constexpr std::size_t most_remembered = std::size_t{1} << 30U;
std::atomic<std::size_t> remembered{0};

// A trace of inertia, that of h c = 3e6 specimens, holds what hangs on a single joint or floats,
// and nothing else feels it.
Shift quasi_static_shift(const Assembly& assembly) {
  const double size = std::max(assembly.width, assembly.height);
  return {1e-13 / (size * size), 1.0};
}

Material unit_material(const Material& material) {
  Material unit = material;
  unit.young = 1.0;
  unit.density = 1.0;
  return unit;
}

}  // namespace

Eigen::VectorXd uniform_stress_forces(const Assembly& assembly, double stress) {
  Eigen::VectorXd forces(2 * static_cast<Eigen::Index>(assembly.joints.size()));
  for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
    const Joint& joint = assembly.joints[j];
    const double pull = stress * joint.length * joint.normal.x();
    forces.segment<2>(static_cast<Eigen::Index>(2 * j)) << -pull * joint.normal.x(),
        -pull * joint.tangent().x();
  }
  return forces;
}

IntactStructure::IntactStructure(const AssemblyOptions& options, const Loading& loading,
                                 const Material& material, bool share)
    : assembly_(build_assembly(options, loading.lateral)),
      shift_(quasi_static_shift(assembly_)),
      bodies_(assembly_, unit_material(material), shift_, share),
      structure_(bodies_) {
  const auto touches = [](const Body& body, const std::vector<int>& side) {
    return std::any_of(side.begin(), side.end(), [&](int node) {
      return node >= body.first_node && node < body.first_node + body.nodes;
    });
  };
  for (std::size_t b = 0; b < assembly_.bodies.size(); ++b)
    if (touches(assembly_.bodies[b], assembly_.left) ||
        touches(assembly_.bodies[b], assembly_.right))
      held_bodies_.push_back(static_cast<int>(b));
  if (!structure_.ok()) return;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(2 * structure_.joints());
  lost_ = none;
  answer_ = stretch(none);
  const Eigen::VectorXd exact = uniform_stress_forces(assembly_, answer_.force / assembly_.height);
  if ((exact - answer_.reactions).norm() <= known * exact.norm()) {
    lost_ = exact - answer_.reactions;
    answer_.reactions = exact;
  } else {
    answer_.residual =
        std::max(answer_.residual, (exact - answer_.reactions).norm() / exact.norm());
  }
}

UnitAnswer IntactStructure::stretch(const Eigen::VectorXd& gaps) const {
  StructureLoads loads{Eigen::VectorXd::Zero(bodies_.dofs()), Eigen::VectorXd::Zero(bodies_.dofs()),
                       gaps, answer_.reactions.norm()};
  for (const int node : assembly_.right) loads.prescribed(2 * node) = assembly_.width;
  const StructureResponse response = structure_.solve(loads);

  UnitAnswer answer{response.displacements, response.reactions + lost_, 0.0, response.residual};
  const Eigen::VectorXd forces = bodies_.shifted_times(answer.displacements) -
                                 joint_forces_on_nodes(bodies_, response.reactions);
  for (const int node : assembly_.right) answer.force += forces(2 * node);
  return answer;
}

double IntactStructure::energy(const Eigen::VectorXd& q) const {
  return 0.5 * q.dot(bodies_.shifted_times(q));
}

std::shared_ptr<const Eigen::MatrixX2d> IntactStructure::reactions_to_jump(int joint) const {
  {
    const std::scoped_lock lock(mutex_);
    const auto found = reactions_.find(joint);
    if (found != reactions_.end()) return found->second;
  }
  auto reactions = std::make_shared<const Eigen::MatrixX2d>(structure_.reactions_to_jump(joint));
  const std::scoped_lock lock(mutex_);
  if (remembered + bytes_per_joint() <= most_remembered &&
      reactions_.emplace(joint, reactions).second)
    remembered += bytes_per_joint();
  return reactions;
}

std::size_t IntactStructure::bytes_per_joint() const {
  return sizeof(double) * 4 * assembly_.joints.size();
}

IntactStructure::~IntactStructure() {
  remembered -= reactions_.size() * bytes_per_joint();
}

std::shared_ptr<const IntactStructure> intact_structure(const Scene& scene) {
  const AssemblyOptions& a = scene.assembly;
  using Key = std::tuple<int, int, int, double, double, double, Lateral, double, Plane, bool>;
  const Key key{a.layers,
                a.fibres,
                a.refinement,
                a.fibre_length,
                a.fibre_height,
                a.orientation,
                scene.loading.lateral,
                scene.material.poisson,
                scene.material.plane,
                scene.solver.leave_out};
  static std::mutex mutex;
  static std::list<std::pair<Key, std::shared_ptr<const IntactStructure>>> recent;

  const std::scoped_lock lock(mutex);
  for (auto entry = recent.begin(); entry != recent.end(); ++entry)
    if (entry->first == key) {
      recent.splice(recent.begin(), recent, entry);
      return entry->second;
    }
  recent.emplace_front(key, std::make_shared<IntactStructure>(a, scene.loading, scene.material,
                                                              scene.solver.leave_out));
  if (recent.size() > kept) recent.pop_back();
  return recent.front().second;
}

}  // namespace havers::sim
