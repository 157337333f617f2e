#include "calib/study/parameter.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace havers::calib {
namespace {

// Every stress that breaks a joint, by the same factor: the ratio, and with it the way of breaking,
// stays.
void scale_thresholds(sim::JointOptions& joints, double factor) {
  joints.head_tail *= factor;
  joints.flank *= factor;
  if (joints.head_tail_shear) *joints.head_tail_shear *= factor;
  if (joints.flank_tension) *joints.flank_tension *= factor;
}

// f₂ acts as shear on a head-tail joint, f₁ as tension on a flank joint, unless set apart (section
// 4 of sim/README.md): the other kind's force over the length of the joint, l or L/2. [Pa]
double default_shear(const sim::Scene& scene) {
  return scene.joints.flank * 0.5 * scene.assembly.fibre_length / scene.assembly.fibre_height;
}

double default_tension(const sim::Scene& scene) {
  return scene.joints.head_tail * scene.assembly.fibre_height / (0.5 * scene.assembly.fibre_length);
}

// (M9) σ₁ stays, and σ₂ follows.
void set_ratio(sim::Scene& scene, double ratio) {
  scene.joints.flank = sim::flank_from_ratio(scene.assembly, scene.joints.head_tail, ratio);
}

/// How a parameter is read from a scene and written to it, in its unit. Each of `all_parameters`
/// has a row, but for those of porosity.
struct Access {
  std::string_view name;
  double (*get)(const sim::Scene&);
  void (*set)(sim::Scene&, double);
};

using sim::Scene;

constexpr std::array accesses{
    Access{"young_GPa", [](const Scene& s) { return s.material.young / 1e9; },
           [](Scene& s, double x) { s.material.young = x * 1e9; }},
    Access{"head_tail_MPa", [](const Scene& s) { return s.joints.head_tail / 1e6; },
           [](Scene& s, double x) { scale_thresholds(s.joints, x * 1e6 / s.joints.head_tail); }},
    Access{"ratio", [](const Scene& s) { return sim::ratio(s.assembly, s.joints); }, set_ratio},
    Access{"scatter", [](const Scene& s) { return s.joints.scatter; },
           [](Scene& s, double x) { s.joints.scatter = x; }},
    Access{"resultant_MPa",
           [](const Scene& s) { return sim::resultant(s.assembly, s.joints) / 1e6; },
           [](Scene& s, double x) {
             scale_thresholds(s.joints, x * 1e6 / sim::resultant(s.assembly, s.joints));
           }},
    Access{"flank_MPa", [](const Scene& s) { return s.joints.flank / 1e6; },
           [](Scene& s, double x) { s.joints.flank = x * 1e6; }},
    Access{"head_tail_shear_MPa",
           [](const Scene& s) { return s.joints.head_tail_shear.value_or(default_shear(s)) / 1e6; },
           [](Scene& s, double x) { s.joints.head_tail_shear = x * 1e6; }},
    Access{"flank_tension_MPa",
           [](const Scene& s) { return s.joints.flank_tension.value_or(default_tension(s)) / 1e6; },
           [](Scene& s, double x) { s.joints.flank_tension = x * 1e6; }},
    Access{"friction", [](const Scene& s) { return s.joints.friction; },
           [](Scene& s, double x) { s.joints.friction = x; }},
    Access{"aspect_ratio",
           [](const Scene& s) { return s.assembly.fibre_length / s.assembly.fibre_height; },
           [](Scene& s, double x) {
             // The ratio depends on the length: it is read before, and kept.
             const double ratio = sim::ratio(s.assembly, s.joints);
             s.assembly.fibre_length = x * s.assembly.fibre_height;
             set_ratio(s, ratio);
           }},
    Access{"poisson", [](const Scene& s) { return s.material.poisson; },
           [](Scene& s, double x) { s.material.poisson = x; }},
    Access{"density_kg_m3", [](const Scene& s) { return s.material.density; },
           [](Scene& s, double x) { s.material.density = x; }},
    Access{"viscosity_s", [](const Scene& s) { return s.material.viscosity; },
           [](Scene& s, double x) { s.material.viscosity = x; }},
};

// The member that a law of porosity calibrates, by the parameter's name; null for a parameter of
// the scene.
double PorosityOptions::*law_of(std::string_view name) {
  if (name == "modulus_exponent") return &PorosityOptions::modulus_exponent;
  if (name == "strength_exponent") return &PorosityOptions::strength_exponent;
  if (name == "linear_offset") return &PorosityOptions::linear_offset;
  return name == "linear_slope" ? &PorosityOptions::linear_slope : nullptr;
}

}  // namespace

const std::vector<ParameterInfo>& all_parameters() {
  constexpr auto logarithmic = Scale::logarithmic, linear = Scale::linear;
  // In the order in which a fit sets them.
  static const std::vector<ParameterInfo> table{
      {"young_GPa", "E", "GPa", 1.0, 60.0, logarithmic, "Young's modulus of the fibres.", true},
      {"head_tail_MPa", "σ₁", "MPa", 1.0, 1000.0, logarithmic,
       "Mean stress that breaks a head-tail joint.", true},
      {"ratio", "r", "", 0.1, 20.0, logarithmic,
       "Force that breaks a head-tail joint over the force that breaks a flank joint.", true},
      {"scatter", "d", "", 0.01, 1.9, linear,
       "Length of the interval from which a joint's threshold is drawn, over its mean.", true},
      {"resultant_MPa", "Σ", "MPa", 1.0, 5000.0, logarithmic,
       "Stress that all joints of a section bear together."},
      {"flank_MPa", "σ₂", "MPa", 0.1, 500.0, logarithmic, "Mean stress that breaks a flank joint."},
      {"head_tail_shear_MPa", "τ₁", "MPa", 0.1, 5000.0, logarithmic,
       "Mean shear stress that breaks a head-tail joint."},
      {"flank_tension_MPa", "σ₂ₙ", "MPa", 0.1, 5000.0, logarithmic,
       "Mean tension that breaks a flank joint."},
      {"friction", "μ", "", 0.0, 1.5, linear, "Coefficient of friction of broken joints."},
      {"aspect_ratio", "L/l", "", 1.0, 100.0, logarithmic,
       "Length of a fibre over its height: how much weaker bone is across than along."},
      {"poisson", "ν", "", 0.01, 0.49, linear, "Poisson's ratio of the fibres."},
      {"density_kg_m3", "ρ", "kg/m³", 500.0, 4000.0, logarithmic, "Density of the fibres."},
      {"viscosity_s", "τ", "s", 1e-9, 1e-5, logarithmic, "Viscosity, as a time."},
      {"modulus_exponent", "m", "", 0.1, 12.0, logarithmic,
       "Exponent of E = E₀ (1−p)^m; needs to_modulus = \"power\".", false, true},
      {"strength_exponent", "n", "", 0.1, 10.0, logarithmic,
       "Exponent of local strength over porosity; needs to_scatter = \"window\".", false, true},
      {"linear_offset", "d₀", "", 0.0, 1.9, linear,
       "Scatter without pores; needs to_scatter = \"linear\".", false, true},
      {"linear_slope", "k", "", 0.0, 20.0, linear,
       "Growth of the scatter with porosity; needs to_scatter = \"linear\".", false, true},
  };
  return table;
}

const ParameterInfo* find_parameter(std::string_view name) {
  const auto& table = all_parameters();
  const auto found = std::ranges::find(table, name, &ParameterInfo::name);
  return found == table.end() ? nullptr : &*found;
}

void apply(sim::Scene& scene, std::string_view name, double value) {
  const auto* const access = std::ranges::find(accesses, name, &Access::name);
  if (access != accesses.end()) access->set(scene, value);
}

double value_of(const sim::Scene& scene, std::string_view name) {
  const auto* const access = std::ranges::find(accesses, name, &Access::name);
  assert(access != accesses.end());
  return access->get(scene);
}

void apply(PorosityOptions& laws, std::string_view name, double value) {
  if (const auto law = law_of(name)) laws.*law = value;
}

double value_of(const PorosityOptions& laws, std::string_view name) {
  assert(law_of(name));
  return laws.*law_of(name);
}

}  // namespace havers::calib
