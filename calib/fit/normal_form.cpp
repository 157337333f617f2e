#include "calib/fit/normal_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace havers::calib {
namespace {

// Raised whenever the same scene gives another response than before: older stores are then not
// used.
constexpr std::string_view model_version = "havers-model-17";

// Reference values (F3). Any would do; with these a joint breaks at a strain of some 1e-5, so that
// the largest strain limit that a scene may have is far away, and the limit asked for can be
// applied to the finished curve.
constexpr double reference_young = 13e9, reference_head_tail = 0.5e6;  // [Pa]
constexpr double reference_max_strain = 1.0;

// Twelve digits: values that differ by the rounding of the scaling alone become equal.
double rounded(double value) {
  return std::stod(fmt::format("{:.12g}", value));
}

void scale(std::optional<double>& stress, double factor) {
  if (stress) stress = rounded(*stress * factor);
}

std::string text(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "-";
}

// The structured bindings name every member: a new one does not compile until it is part of the
// key.
std::string text(const sim::AssemblyOptions& options) {
  const auto& [layers, fibres, length, height, orientation, refinement] = options;
  return fmt::format("{} {} {} {} {} {}", layers, fibres, length, height, orientation, refinement);
}

std::string text(const sim::Material& material) {
  const auto& [young, poisson, density, plane, viscosity, contrast] = material;
  return fmt::format("{} {} {} {} {} {}", young, poisson, density, static_cast<int>(plane),
                     viscosity, contrast);
}

std::string text(const sim::JointOptions& joints, bool reinforced) {
  const auto& [head_tail, flank, head_tail_shear, flank_tension, scatter, distribution, missing,
               friction, boundary, seed, thresholds] = joints;
  static_cast<void>(boundary);  // settled in `reinforced`
  std::string result = fmt::format(
      "{} {} {} {} {} {} {} {} {} {}", head_tail, flank, text(head_tail_shear), text(flank_tension),
      scatter, static_cast<int>(distribution), missing, friction, reinforced, seed);
  for (const auto& [normal, tangent] : thresholds) result += fmt::format(" {} {}", normal, tangent);
  return result;
}

std::string text(const sim::Loading& loading) {
  const auto& [rate, lateral, start, max_strain, end_fraction] = loading;
  return fmt::format("{} {} {} {} {}", rate, static_cast<int>(lateral), static_cast<int>(start),
                     max_strain, end_fraction);
}

std::string text(const sim::SolverOptions& solver) {
  const auto& [regime, step, leap, accuracy, contact, tolerance, max_iterations, leave_out] =
      solver;
  return fmt::format("{} {} {} {} {} {} {}{}", static_cast<int>(regime), text(step), accuracy,
                     static_cast<int>(contact), tolerance, max_iterations, leave_out,
                     leap ? " leap" : "");
}

// The curve up to the limit, where it ends unbroken: strength and failure strain of what is left.
void cut_at(double max_strain, Response& response) {
  auto& [failed, broke, why, modulus, strength, failure_strain, strain, stress] = response;
  if (failed || strain.empty() || strain.back() <= max_strain) return;
  const auto beyond = std::ranges::upper_bound(strain, max_strain);
  const auto n = static_cast<std::size_t>(beyond - strain.begin());
  // Before the first row a curve has the slope of its modulus.
  double end = modulus * max_strain;
  if (n > 0) {
    const double part = (max_strain - strain[n - 1]) / (strain[n] - strain[n - 1]);
    end = stress[n - 1] + part * (stress[n] - stress[n - 1]);
  }
  strain.resize(n);
  stress.resize(n);
  strain.push_back(max_strain);
  stress.push_back(end);
  const auto peak = std::ranges::max_element(stress);
  broke = false;
  strength = *peak;
  failure_strain = strain[static_cast<std::size_t>(peak - stress.begin())];
}

}  // namespace

NormalForm normal_form(const sim::Scene& scene, bool quasi_static) {
  NormalForm form{.scene = scene, .max_strain = scene.loading.max_strain};
  // Thresholds from a file do not follow σ₁.
  if (!scene.joints.thresholds.empty()) return form;
  // Where nothing is drawn all seeds are one simulation.
  if (scene.joints.scatter == 0.0 && scene.joints.missing == 0.0) form.scene.joints.seed = 0;
  if (!quasi_static) return form;

  const double to_reference = reference_head_tail / scene.joints.head_tail;
  const double strain_factor = reference_young / scene.material.young / to_reference;
  // Else the curve of the reference would end before the strain limit asked for.
  if (form.max_strain > strain_factor * reference_max_strain) return form;
  form.scaled = true;
  form.stress_factor = 1.0 / to_reference;
  form.strain_factor = strain_factor;

  auto& [assembly, material, joints, loading, solver] = form.scene;
  material.young = reference_young;
  // The limit knows neither inertia nor rate nor step: whatever they are, the key is the same.
  material.density = sim::Material{}.density;
  joints.head_tail = reference_head_tail;
  joints.flank = rounded(joints.flank * to_reference);
  scale(joints.head_tail_shear, to_reference);
  scale(joints.flank_tension, to_reference);
  joints.scatter = rounded(joints.scatter);
  loading.strain_rate = sim::Loading{}.strain_rate;
  loading.max_strain = reference_max_strain;
  solver.regime = sim::Regime::quasi_static;
  solver.step.reset();
  return form;
}

Response rescaled(Response response, const NormalForm& form) {
  if (!form.scaled) return response;
  response.modulus *= form.stress_factor / form.strain_factor;
  response.strength *= form.stress_factor;
  response.failure_strain *= form.strain_factor;
  for (double& strain : response.strain) strain *= form.strain_factor;
  for (double& stress : response.stress) stress *= form.stress_factor;
  cut_at(form.max_strain, response);
  return response;
}

std::string key_of(const sim::Scene& scene) {
  const auto& [assembly, material, joints, loading, solver] = scene;
  return fmt::format("{} | {} | {} | {} | {} | {}", model_version, text(assembly), text(material),
                     text(joints, sim::reinforced_boundary(scene)), text(loading), text(solver));
}

}  // namespace havers::calib
