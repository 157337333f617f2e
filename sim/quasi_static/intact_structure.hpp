// The factorised intact assembly: the part of a quasi-static run that no seed, threshold or modulus
// changes.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sim/structure/structure.hpp"

namespace havers::sim {

/// Answer of a structure of Young's modulus 1 to the strain 1. Everything scales with E and ε.
struct UnitAnswer {
  Eigen::VectorXd displacements;  ///< [m]
  Eigen::VectorXd reactions;      ///< Of all joints. [N/m]
  double force = 0.0;             ///< Of the machine. [N/m]
  double residual = 0.0;          ///< Of the solve. [-]
};

/// Forces of all joints under a uniform stress [Pa] along the load (M1). [N/m]
Eigen::VectorXd uniform_stress_forces(const Assembly& assembly, double stress);

/// An assembly of Young's modulus 1, factorised, and its answers: to the strain 1, and to jumps as
/// they are asked for.
class IntactStructure {
 public:
  /// Factorises. Where structure() is not ok(), there is no answer and nothing may be solved.
  explicit IntactStructure(const Scene& scene);
  IntactStructure(const IntactStructure&) = delete;
  IntactStructure& operator=(const IntactStructure&) = delete;
  ~IntactStructure();

  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  [[nodiscard]] const Structure& structure() const { return structure_; }
  /// No gaps. Its residual is that of a solve, or how far a solve misses the uniform stress where
  /// layers are alike and self-stress is not determined (M10).
  [[nodiscard]] const UnitAnswer& answer() const { return answer_; }
  /// Whether the uniform stress (M1), which a solve misses by rounding, stands in for it.
  [[nodiscard]] bool stress_is_known() const { return stress_is_known_; }
  /// With given gaps at the joints. [m]
  [[nodiscard]] UnitAnswer stretch(const Eigen::VectorXd& gaps) const;
  /// ½ qᵀKq. [J/m]
  [[nodiscard]] double energy(const Eigen::VectorXd& q) const;
  /// Joints that a body is part of, in the order of their index.
  [[nodiscard]] const std::vector<int>& joints_of(int body) const {
    return joints_of_bodies_[static_cast<std::size_t>(body)];
  }

  // What these two find is remembered for later runs while there is room. Both may be called by
  // several threads.
  /// Structure::jump.
  [[nodiscard]] SharedJump jump(int joint) const;
  /// Structure::nearly_reactions_to of a unit jump at one joint, normal and tangential. [N/m²]
  using SharedColumn = std::shared_ptr<const NearReactions>;
  /// None the first time that a joint is asked for, as most never are again.
  /// @param make  whether to make it from the second time on; else none until it is made
  [[nodiscard]] SharedColumn column(const SharedJump& jump, bool make) const;
  /// So many columns are added up in the time of nearly_reactions_to.
  [[nodiscard]] std::size_t columns_of_a_glance() const;
  /// Structure::nearly_reactions_to.
  [[nodiscard]] NearReactions nearly_reactions_to(const std::vector<SharedJump>& jumps,
                                                  const Eigen::MatrixXd& y) const {
    return structure_.nearly_reactions_to(jumps, y, *single_);
  }

 private:
  Assembly assembly_;
  Bodies bodies_;
  Structure structure_;
  std::optional<SinglePrecisionFactor> single_;  // of the structure, where it needs a factor
  UnitAnswer answer_;
  bool stress_is_known_ = false;
  Eigen::VectorXd lost_;     // forces of the uniform stress that a solve does not find [N/m]
  double lost_force_ = 0.0;  // and of that at the end
  std::vector<std::vector<int>> joints_of_bodies_;
  mutable std::mutex mutex_;
  mutable std::map<int, SharedJump> jumps_;      // at each joint
  mutable std::map<int, SharedColumn> columns_;  // of each that was asked for; none: not made
};

/// The one for a scene, made once and shared between runs and threads; the last few are kept.
std::shared_ptr<const IntactStructure> intact_structure(const Scene& scene);

}  // namespace havers::sim
