// What follows from a scene's numbers alone, and the complaints about one that cannot be simulated.
// A complaint names the key of a scene file, and shows a value in its unit.
#include "sim/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "sim/assembly/assembly.hpp"
#include "sim/dynamics/step_control.hpp"
#include "sim/dynamics/time_stepping.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/simulate.hpp"

namespace havers::sim {

double ratio(const AssemblyOptions& assembly, const JointOptions& joints) {
  return 2.0 * joints.head_tail * assembly.fibre_height / (joints.flank * assembly.fibre_length);
}

double resultant(const AssemblyOptions& assembly, const JointOptions& joints) {
  const double n = assembly.layers;
  const double slenderness = assembly.fibre_length / assembly.fibre_height;
  return joints.head_tail + 0.5 * (1.0 + 1.0 / n) * slenderness * joints.flank;
}

double flank_from_ratio(const AssemblyOptions& assembly, double head_tail, double ratio) {
  return 2.0 * head_tail * assembly.fibre_height / (ratio * assembly.fibre_length);
}

double head_tail_from_resultant(const AssemblyOptions& assembly, double resultant, double ratio) {
  return resultant / (1.0 + (1.0 + 1.0 / assembly.layers) / ratio);
}

double young_of_layer(const Material& material, int layer) {
  return material.young * (layer % 2 == 0 ? 1.0 : material.layer_contrast);
}

double lateral_contraction(const Material& material) {
  const double nu = material.poisson;
  return material.plane == Plane::stress ? nu : nu / (1.0 - nu);
}

double plane_stiffening(const Material& material) {
  const double nu = material.poisson;
  return material.plane == Plane::stress ? 1.0 : 1.0 / (1.0 - nu * nu);
}

double wave_speed(const Material& material) {
  return std::sqrt(material.young / material.density);
}

bool reinforced_boundary(const Scene& scene) {
  return scene.joints.reinforced_boundary.value_or(scene.assembly.orientation == 0.0);
}

namespace {

// Products of a few settings then are numbers too.
constexpr double largest_number = 1e30, smallest_number = 1e-30;

bool is_positive(double value) {
  return value >= smallest_number && value <= largest_number;
}
bool is_not_negative(double value) {
  return value == 0.0 || is_positive(value);
}

// Collects complaints; a value is shown in the unit of its key. Rules are written such that NaN
// breaks them.
class Checker {
 public:
  void require(bool holds, std::string_view key, double value, std::string_view rule,
               std::string_view hint = {}) {
    if (!holds) say(key, fmt::format("is {:g}, must be {}", value, rule), hint);
  }
  void positive(std::string_view key, double value) {
    require(is_positive(value), key, value, value > 0.0 ? numbers() : "above 0");
  }
  void not_negative(std::string_view key, double value) {
    require(is_not_negative(value), key, value, value > 0.0 ? numbers() : "0 or more");
  }
  void say(std::string_view key, std::string what, std::string_view hint = {}) {
    found_.push_back({std::string(key), std::move(what), std::string(hint)});
  }
  [[nodiscard]] const std::vector<Scene::Problem>& found() const { return found_; }

 private:
  static std::string numbers() {
    return fmt::format("from {:g} to {:g}", smallest_number, largest_number);
  }

  std::vector<Scene::Problem> found_;
};

void check_assembly(const AssemblyOptions& assembly, Checker& checker) {
  // Limits of the fibres, of the cells of the grid around a turned specimen, and of length to
  // height.
  constexpr double most_fibres = 1e6, most_cells = 1e7, most_slender = 1e6;
  const double fibres = static_cast<double>(assembly.layers) * assembly.fibres;
  checker.require(assembly.layers >= 1, "assembly.layers", assembly.layers, "at least 1");
  checker.require(assembly.fibres >= 1, "assembly.fibres", assembly.fibres, "at least 1");
  if (assembly.layers >= 1 && assembly.fibres >= 1 && fibres > most_fibres)
    checker.say(
        "assembly.layers",
        fmt::format("times fibres is {:g} fibres, must be at most {:g}", fibres, most_fibres),
        "check layers and fibres");

  // Every fibre then is held at an end, and joints may push and pull each other at no cost (M10).
  if (assembly.fibres == 1 && assembly.layers >= 3 && assembly.orientation == 0.0)
    checker.say("assembly.fibres",
                fmt::format("is 1 in each of {} layers along the load, which leaves the forces of "
                            "their joints undetermined",
                            assembly.layers),
                "take 2 fibres or more, or at most 2 layers");

  checker.positive("assembly.fibre_length_um", assembly.fibre_length * 1e6);
  checker.positive("assembly.fibre_height_um", assembly.fibre_height * 1e6);
  if (is_positive(assembly.fibre_length) && is_positive(assembly.fibre_height)) {
    checker.require(assembly.fibre_length >= assembly.fibre_height, "assembly.fibre_length_um",
                    assembly.fibre_length * 1e6, "at least fibre_height_um",
                    "a fibre is longer than it is high");
    checker.require(assembly.fibre_length <= most_slender * assembly.fibre_height,
                    "assembly.fibre_length_um", assembly.fibre_length * 1e6,
                    fmt::format("at most {:g} times fibre_height_um", most_slender));
  }

  // The grid of fibres is as large as the box around the turned specimen.
  const double c = std::abs(std::cos(assembly.orientation)),
               s = std::abs(std::sin(assembly.orientation));
  const double cells = (assembly.width() * c + assembly.height() * s) / assembly.fibre_length *
                       (assembly.width() * s + assembly.height() * c) / assembly.fibre_height;
  // Where there are too many fibres, that has been said already.
  if (fibres <= most_fibres && cells > most_cells)
    checker.say("assembly.orientation_deg",
                fmt::format("needs a grid of {:.2g} fibres around so long and narrow a specimen, "
                            "must be at most {:g}",
                            cells, most_cells),
                "check layers, fibres and their size");

  const double degrees = assembly.orientation * 180.0 / std::numbers::pi;
  checker.require(degrees > -90.0 && degrees <= 90.0, "assembly.orientation_deg", degrees,
                  "above -90 and at most 90", "the angle between fibre axis and loading axis");
  const int k = assembly.refinement;
  checker.require(k == 1 || k == 2 || k == 4, "assembly.refinement", k, "1, 2 or 4",
                  "8, 32 or 128 triangles a fibre");
}

void check_material(const Material& material, Checker& checker) {
  checker.positive("material.young_GPa", material.young / 1e9);
  // At 1/2 plane strain is incompressible and has no stiffness matrix; plane stress has one.
  if (material.plane == Plane::stress)
    checker.require(material.poisson > -1.0 && material.poisson <= 0.5, "material.poisson",
                    material.poisson, "above -1 and at most 0.5");
  else
    checker.require(material.poisson > -1.0 && material.poisson < 0.5, "material.poisson",
                    material.poisson, "above -1 and below 0.5 in plane strain");
  checker.positive("material.density_kg_m3", material.density);
  checker.not_negative("material.viscosity_s", material.viscosity);
  checker.require(material.layer_contrast > 0.0 && material.layer_contrast <= 1.0,
                  "material.layer_contrast", material.layer_contrast, "above 0 and at most 1");
}

void check_joints(const JointOptions& joints, Checker& checker) {
  checker.positive("joints.head_tail_MPa", joints.head_tail / 1e6);
  checker.positive("joints.flank_MPa", joints.flank / 1e6);
  if (joints.head_tail_shear)
    checker.not_negative("joints.head_tail_shear_MPa", *joints.head_tail_shear / 1e6);
  // f_T may be 0, but f_N may not, as μ_c is f_T/f_N (M5).
  if (joints.flank_tension)
    checker.positive("joints.flank_tension_MPa", *joints.flank_tension / 1e6);
  checker.require(joints.scatter >= 0.0 && joints.scatter < 2.0, "joints.scatter", joints.scatter,
                  "at least 0 and below 2", "the length of the interval of threshold factors");
  checker.require(joints.missing >= 0.0 && joints.missing < 1.0, "joints.missing", joints.missing,
                  "at least 0 and below 1", "the fraction of joints that pores take away");
  checker.not_negative("joints.friction", joints.friction);
}

void check_loading(const Loading& loading, Checker& checker) {
  checker.positive("loading.strain_rate_per_s", loading.strain_rate);
  checker.require(loading.max_strain > 0.0 && loading.max_strain <= 1.0, "loading.max_strain",
                  loading.max_strain, "above 0 and at most 1", "a fraction, not per cent");
  checker.require(loading.end_fraction >= 0.0 && loading.end_fraction < 1.0, "loading.end_fraction",
                  loading.end_fraction, "at least 0 and below 1", "a part of the strength");
}

void check_solver(const SolverOptions& solver, Checker& checker) {
  if (solver.step) checker.positive("solver.step_s", *solver.step);
  checker.require(solver.step_accuracy > 0.0 && solver.step_accuracy < 1.0, "solver.step_accuracy",
                  solver.step_accuracy, "above 0 and below 1");
  checker.require(solver.tolerance > 0.0 && solver.tolerance < 1.0, "solver.tolerance",
                  solver.tolerance, "above 0 and below 1");
  checker.require(solver.max_iterations >= 1, "solver.max_iterations", solver.max_iterations,
                  "at least 1");
}

// A step must not be longer than the test. To the strain σ₁/E, about where the specimen fails, they
// must not be too many. Runs that leap need few, and a chosen step is at most the first.
void check_steps(const Scene& scene, Checker& checker) {
  const bool given = scene.solver.step.has_value();
  if (may_leap(scene) || choose_regime(scene).regime == Regime::quasi_static) return;
  const double step = given ? *scene.solver.step : first_step(scene);
  const double of_one = scene.loading.strain_rate * step;
  if (of_one > scene.loading.max_strain)
    checker.say("solver.step_s",
                fmt::format("is {:g}: one step is a strain of {:.2g}, and the test ends at {:g}",
                            step, of_one, scene.loading.max_strain),
                "leave step_s out, and the step is chosen");
  const double strain =
      std::min(scene.loading.max_strain, head_tail_strength(scene) / scene.material.young);
  const double steps = strain / of_one;
  if (steps <= most_steps_of_a_run) return;
  if (given)
    checker.say(
        "solver.step_s",
        fmt::format("is {:g}: a strain of {:.2g} is {:.2g} steps away", step, strain, steps),
        "leave step_s out, and the step is chosen");
  else
    checker.say(
        "loading.strain_rate_per_s",
        fmt::format("is {:g}: where every step is taken, a strain of {:.2g} is {:.2g} steps "
                    "of {:.2g} s away",
                    scene.loading.strain_rate, strain, steps, step),
        "start = \"uniform\" with leave_out = true leaps to the first break");
}

// Needs an assembly that is sound: it lays it to count its joints.
void check_thresholds(const Scene& scene, Checker& checker) {
  const std::vector<Threshold>& given = scene.joints.thresholds;
  const std::size_t joints = build_assembly(scene.assembly, scene.loading.lateral).joints.size();
  if (given.size() != joints)
    checker.say("joints.thresholds_file",
                fmt::format("names {} joint{}, the assembly has {}", given.size(),
                            given.size() == 1 ? "" : "s", joints),
                "write a matching file with havers simulate: joints.csv");
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto& [normal, tangent] = given[i];
    if (normal > 0.0 && tangent >= 0.0 && std::isfinite(normal + tangent)) continue;
    if (is_missing(given[i])) continue;
    checker.say("joints.thresholds_file",
                fmt::format("gives joint {} f_N = {:g} and f_T = {:g} N/m, must be f_N above 0 and "
                            "f_T 0 or more, or both 0 for a joint that is missing",
                            i, given[i].normal, given[i].tangent));
    return;  // one such sentence says enough
  }
}

}  // namespace

bool is_missing(const Threshold& threshold) {
  return threshold.normal == 0.0 && threshold.tangent == 0.0;
}

bool some_are_missing(const JointOptions& joints) {
  return joints.missing > 0.0 || std::ranges::any_of(joints.thresholds, is_missing);
}

std::vector<Scene::Problem> Scene::problems() const {
  // Thresholds are checked only where the assembly can be laid, which they need, and steps, which
  // need a regime, only where all else is right.
  Checker checker;
  check_assembly(assembly, checker);
  const bool can_be_laid = checker.found().empty();
  check_material(material, checker);
  check_joints(joints, checker);
  if (can_be_laid && !joints.thresholds.empty()) check_thresholds(*this, checker);
  check_loading(loading, checker);
  check_solver(solver, checker);
  if (checker.found().empty()) check_steps(*this, checker);
  return checker.found();
}

}  // namespace havers::sim
