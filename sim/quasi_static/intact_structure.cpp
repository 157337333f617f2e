// A modulus of 1, a density of 1 and a strain of 1: what depends on the scene's modulus, thresholds
// and seed is a factor or a change of few joints, so that runs share what is computed here.
#include "sim/quasi_static/intact_structure.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <list>
#include <tuple>

#include "sim/contact/joint_step.hpp"
#include "sim/structure/pieces.hpp"

namespace havers::sim {
namespace {

constexpr std::size_t kept = 8;  // structures
// Part of the forces by which the solved ones may miss those of the uniform stress, which then
// stand in for them. Where they miss by more, self-stress is not determined (M10).
constexpr double known = 1e-6;
// Of jumps and what they do, all structures together.
constexpr std::size_t most_remembered = std::size_t{1} << 30U;
std::atomic<std::size_t> remembered{0};

std::size_t bytes(const Jump& jump) {
  return jump.half.rows.size() * (sizeof(int) + 2 * sizeof(double));
}

std::size_t bytes(const NearReactions& column) {
  return sizeof(float) * static_cast<std::size_t>(column.reactions.size());
}

// To add up a column of reactions takes as long as half a solve spends on so many nonzeros of the
// factor a joint.
constexpr long nonzeros_of_a_column = 3;

// A trace of inertia, that of h c = 3e6 specimens, holds what hangs on a single joint or floats,
// and nothing else feels it.
Shift quasi_static_shift(const Assembly& assembly) {
  const double size = std::max(assembly.width, assembly.height);
  return {1e-13 / (size * size), 1.0};
}

// The modulus is a factor of all answers; with these c is 1.
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
    // Traction times s. A pull is negative, as reactions count what presses.
    const double pull = stress * joint.length * joint.normal.x();
    forces.segment<2>(static_cast<Eigen::Index>(2 * j)) << -pull * joint.normal.x(),
        -pull * joint.tangent().x();
  }
  return forces;
}

IntactStructure::IntactStructure(const Scene& scene)
    : assembly_(build_assembly(scene.assembly, scene.loading.lateral)),
      bodies_(assembly_, unit_material(scene.material), quasi_static_shift(assembly_),
              scene.solver.leave_out),
      structure_(bodies_),
      joints_of_bodies_(joints_of_bodies(assembly_)) {
  if (!structure_.ok()) return;
  if (structure_.joints() > 0) single_.emplace(structure_.factor());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(2 * structure_.joints());
  lost_ = none;
  answer_ = stretch(none);
  // Layers that are unlike have no uniform stress to be compared with.
  if (structure_.joints() == 0 || scene.material.layer_contrast != 1.0) return;
  const double stress = plane_stiffening(scene.material), force = stress * assembly_.height;
  const Eigen::VectorXd exact = uniform_stress_forces(assembly_, stress);
  const double missed = std::max((exact - answer_.reactions).norm() / exact.norm(),
                                 std::abs(answer_.force / force - 1.0));
  // Every later answer contains this one: what the solve missed of it is added to each.
  stress_is_known_ = scene.solver.leave_out && missed <= known;
  if (stress_is_known_) {
    lost_ = exact - answer_.reactions;
    lost_force_ = force - answer_.force;
    answer_.reactions = exact;
    answer_.force = force;
  } else {
    answer_.residual = std::max(answer_.residual, missed);
  }
}

UnitAnswer IntactStructure::stretch(const Eigen::VectorXd& gaps) const {
  StructureLoads loads{Eigen::VectorXd::Zero(bodies_.dofs()), Eigen::VectorXd::Zero(bodies_.dofs()),
                       gaps, answer_.reactions.norm()};
  for (const int node : assembly_.right) loads.prescribed(2 * node) = assembly_.width;
  const StructureResponse response = structure_.solve(loads);

  UnitAnswer answer{response.displacements, response.reactions + lost_, lost_force_,
                    response.residual};
  // The forces on the held nodes beyond those of joints, from the balance of all forces.
  const Eigen::VectorXd forces = bodies_.shifted_times(answer.displacements) -
                                 joint_forces_on_nodes(bodies_, response.reactions);
  for (const int node : assembly_.right) answer.force += forces(2 * node);
  return answer;
}

double IntactStructure::energy(const Eigen::VectorXd& q) const {
  return 0.5 * q.dot(bodies_.stiffness_times(q));
}

SharedJump IntactStructure::jump(int joint) const {
  {
    const std::scoped_lock lock(mutex_);
    const auto found = jumps_.find(joint);
    if (found != jumps_.end()) return found->second;
  }
  // Found without the lock, so that threads do not wait: two may find the same one, of which one is
  // kept.
  auto jump = std::make_shared<const Jump>(structure_.jump(joint));
  const std::scoped_lock lock(mutex_);
  if (remembered + bytes(*jump) <= most_remembered && jumps_.emplace(joint, jump).second)
    remembered += bytes(*jump);
  return jump;
}

IntactStructure::SharedColumn IntactStructure::column(const SharedJump& jump, bool make) const {
  {
    const std::scoped_lock lock(mutex_);
    // A joint that is asked for once is not worth a column; that it was asked for is remembered.
    const auto [place, is_new] = columns_.try_emplace(jump->joint);
    if (is_new || place->second || !make) return place->second;
  }
  auto column = std::make_shared<const NearReactions>(
      nearly_reactions_to({jump}, Eigen::Matrix2d::Identity()));
  const std::scoped_lock lock(mutex_);
  SharedColumn& place = columns_[jump->joint];
  if (!place && remembered + bytes(*column) <= most_remembered) {
    remembered += bytes(*column);
    place = column;
  }
  return column;
}

std::size_t IntactStructure::columns_of_a_glance() const {
  const Eigen::Index joints = std::max<Eigen::Index>(1, structure_.joints());
  return static_cast<std::size_t>(structure_.factor().nonzeros() / (nonzeros_of_a_column * joints));
}

IntactStructure::~IntactStructure() {
  // All structures share one limit: what this one took of it is free again.
  for (const auto& [joint, jump] : jumps_) remembered -= bytes(*jump);
  for (const auto& [joint, column] : columns_)
    if (column) remembered -= bytes(*column);
}

std::shared_ptr<const IntactStructure> intact_structure(const Scene& scene) {
  const AssemblyOptions& a = scene.assembly;
  // What the factor depends on, and nothing else.
  using Key =
      std::tuple<int, int, int, double, double, double, Lateral, double, Plane, double, bool>;
  const Key key{a.layers,
                a.fibres,
                a.refinement,
                a.fibre_length,
                a.fibre_height,
                a.orientation,
                scene.loading.lateral,
                scene.material.poisson,
                scene.material.plane,
                scene.material.layer_contrast,
                scene.solver.leave_out};
  struct Entry {
    Key key;
    std::once_flag once;  // others need not wait while one is made
    std::shared_ptr<const IntactStructure> made;
  };
  static std::mutex mutex;
  static std::list<std::shared_ptr<Entry>> recent;

  std::shared_ptr<Entry> entry;
  {
    const std::scoped_lock lock(mutex);
    const auto found = std::ranges::find_if(
        recent, [&](const std::shared_ptr<Entry>& one) { return one->key == key; });
    if (found == recent.end())
      // The last one used comes first; the one not used for longest goes.
      recent.emplace_front(std::make_shared<Entry>())->key = key;
    else
      recent.splice(recent.begin(), recent, found);
    if (recent.size() > kept) recent.pop_back();
    entry = recent.front();
  }
  std::call_once(entry->once, [&] { entry->made = std::make_shared<IntactStructure>(scene); });
  return entry->made;
}

}  // namespace havers::sim
