// A step's joint problem as Siconos sees it: u = W r + q with Coulomb's law, three rows a joint.
#pragma once

#include "sim/contact/joint_step.hpp"

namespace havers::test {

enum class SiconosSolver { nsgs, newton };

struct SiconosAnswer {
  Eigen::VectorXd reactions;  ///< R_N and R_T of every joint. [N/m]
  int iterations = 0;
  bool converged = false;  ///< By Siconos' own measure.
  double cpu = 0.0;        ///< Of the solver alone. [s]
};

/// Precondition: the step has no ties, and nothing is prescribed. Lengths are scaled so that the
/// reactions of a bonded joint are of size 1.
SiconosAnswer solve_with_siconos(const sim::Bodies& bodies, const sim::JointStep& step,
                                 SiconosSolver solver, double tolerance, int max_iterations);

}  // namespace havers::test
