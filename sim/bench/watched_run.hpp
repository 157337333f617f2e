// A simulation with what a comparison needs to know about it: joint forces on the way, and its
// cost.
#pragma once

#include <vector>

#include "sim/simulation.hpp"

namespace havers::sim {

/// Forces are R_N and R_T of every joint.
struct WatchedRun {
  Simulation simulation;
  Eigen::VectorXd bonded_forces;  ///< At the strain asked for; empty when a joint broke before, or,
                                  ///< in the quasi-static limit, was missing. [N/m]
  std::vector<int> order;         ///< Joints in the order of breaking.
  std::vector<Eigen::VectorXd> forces_at_break;  ///< After the row of each break, but of the last
                                                 ///< of large walls. [N/m]
  double wall = 0.0, cpu = 0.0;                  ///< [s]
  bool out_of_time = false;                      ///< Stopped at the limit.
};

/// How a run is watched.
struct WatchOptions {
  double bonded_strain = 0.0;  ///< Where `bonded_forces` are taken, on the line through the rows
                               ///< around it, which a run that leaps has before and after. [-]
  double time_limit = 60.0;    ///< Wall time. [s]
};

/// Simulates the scene until it ends, is stopped or has taken its time. Its joints are asked for
/// until the bonded forces are known, and in rows with breaks.
WatchedRun watch(const Scene& scene, const WatchOptions& options, const StopAsked& stop_asked);

/// Joints that break in the reference's order before the two runs part.
std::size_t same_breaks(const WatchedRun& run, const WatchedRun& reference);

/// Error of all joint forces after the last of these breaks of which both have them, relative to
/// the largest the reference has had until then, as the last break may take all load away; NaN
/// without such a break. [-]
double force_error(const WatchedRun& run, const WatchedRun& reference);

// Closed forms of the bonded specimen. Where layers are not alike they hold if these lie along the
// load, or across it without lateral contraction.

/// Modulus along the load: layers share the strain at 0°, else the stress. [Pa]
double bonded_modulus(const Scene& scene);

/// Forces of all joints: the stress of each layer is uniform (M1). [N/m]
Eigen::VectorXd bonded_forces_at(const Scene& scene, double strain);

/// Strain at which a joint first meets its cone under these; infinite when none ever does. [-]
double first_break_by_uniform_stress(const Scene& scene);

}  // namespace havers::sim
