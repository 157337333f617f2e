// The factorised intact assembly: the part of a quasi-static run that no seed, threshold or modulus changes.
#pragma once

#include <memory>

#include "sim/structure/structure.hpp"

namespace havers::sim {

/// An assembly of Young's modulus 1 and its answer to the strain 1. Everything scales with E and ε.
struct IntactStructure {
  IntactStructure(const AssemblyOptions& options, const Loading& loading, const Material& material, bool share);
  IntactStructure(const IntactStructure&) = delete;
  IntactStructure& operator=(const IntactStructure&) = delete;
  ~IntactStructure() = default;

  /// The answer to the strain 1 and given gaps of all joints.
  [[nodiscard]] StructureResponse stretch(const Eigen::VectorXd& gaps) const;

  /// Force of the machine for displacements q and reactions r. [N/m, for E = 1]
  [[nodiscard]] double end_force(const Eigen::VectorXd& q, const Eigen::VectorXd& reactions) const;

  Assembly assembly;
  Bodies bodies;
  Structure structure;
  Eigen::VectorXd reactions;  ///< Of all joints, nothing broken. [N/m, for E = 1 and ε = 1]
  double force = 0.0;         ///< Of the machine. [N/m, likewise]
};

/// The one for a scene, made once and shared between runs and threads; the last few are kept.
std::shared_ptr<const IntactStructure> intact_structure(const Scene& scene);

}  // namespace havers::sim
