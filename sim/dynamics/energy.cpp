// Energies come from states and work from forces: that both agree to rounding is the check (M4).
#include "sim/dynamics/energy.hpp"

#include <algorithm>
#include <cmath>

#include "sim/outcome.hpp"

namespace havers::sim {
namespace {

double kinetic_energy(const Eigen::VectorXd& v, const Eigen::VectorXd& mass) {
  return 0.5 * v.cwiseAbs2().dot(mass);
}

}  // namespace

void EnergyBalance::start(const Motion& motion, const Eigen::VectorXd& mass) {
  kinetic = kinetic_energy(motion.v, mass);
  elastic = 0.5 * motion.q.dot(motion.Kq);
  // All energy that is there now counts as work done so far.
  external = largest_ = kinetic + elastic + joints + viscous + numerical;
}

void EnergyBalance::add(const Step& step, const Motion& before, const Motion& after,
                        const Eigen::VectorXd& mass) {
  const double h = step.time;
  const double kinetic_change = kinetic_energy(after.v, mass) - kinetic;
  const double elastic_change = 0.5 * after.q.dot(after.Kq) - elastic;
  const double viscous_step = h * step.viscosity * after.v.dot(after.Kv);
  // ½ΔvᵀMΔv + ½(hv⁺)ᵀK(hv⁺): what the method loses, and bone does not.
  const double numerical_step =
      kinetic_energy(after.v - before.v, mass) + 0.5 * h * h * after.v.dot(after.Kv);
  const double defect =
      step.external_work -
      (kinetic_change + elastic_change + step.joint_dissipation + viscous_step + numerical_step);
  kinetic += kinetic_change;
  elastic += elastic_change;
  external += step.external_work;
  joints += step.joint_dissipation;
  viscous += viscous_step;
  numerical += numerical_step;
  largest_ =
      std::max({largest_, kinetic + elastic, std::abs(external), std::abs(step.external_work)});
  if (largest_ > 0.0) relative_defect = worse(relative_defect, std::abs(defect) / largest_);
}

}  // namespace havers::sim
