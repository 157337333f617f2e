// The discrete energy balance (M4): the simulator's own check of itself.
#pragma once

#include <Eigen/Core>

#include "sim/structure/bodies.hpp"

namespace havers::sim {

/// State of motion at the end of a step.
struct Motion {
  Eigen::VectorXd q;   ///< Displacements. [m]
  Eigen::VectorXd v;   ///< Velocities. [m/s]
  Eigen::VectorXd Kq;  ///< K q. [N/m]
  Eigen::VectorXd Kv;  ///< K v. [N/(m s)]
};

/// Sums since the start, per unit thickness.
struct EnergyBalance {
  double kinetic = 0.0;          ///< T. [J/m]
  double elastic = 0.0;          ///< U. [J/m]
  double external = 0.0;         ///< W_ext, with the initial energies. [J/m]
  double joints = 0.0;           ///< D_joint. [J/m]
  double viscous = 0.0;          ///< D_visc. [J/m]
  double numerical = 0.0;        ///< Taken by implicit Euler. [J/m]
  double relative_defect = 0.0;  ///< Largest so far, relative to the largest energy so far. [-]

  /// Starts the account, or starts it again, with the energies of the present state; what was taken
  /// before stays, and is part of the work.
  void start(const Motion& motion, const Eigen::VectorXd& mass);

  /// What one step did.
  struct Step {
    double time = 0.0;               ///< h. [s]
    double viscosity = 0.0;          ///< τ. [s]
    double external_work = 0.0;      ///< [J/m]
    double joint_dissipation = 0.0;  ///< −r·Δgap. [J/m]
  };
  /// Adds a step between two states, and its defect in (M4).
  void add(const Step& step, const Motion& before, const Motion& after,
           const Eigen::VectorXd& mass);

 private:
  double largest_ = 0.0;  // energy so far, with which defects are compared [J/m]
};

}  // namespace havers::sim
