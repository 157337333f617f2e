// Keys of a scene in words for a reader, with their symbols and units.
#include "reports/sweep/sweep_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/text/format.hpp"

namespace havers::reports {

namespace {

struct KeyWords {
  std::string name, unit;
  std::string at_a_value = name;
};

KeyWords words_of(const std::string& key) {
  static const std::map<std::string, KeyWords> known{
      {"assembly.layers", {"layers N", ""}},
      {"assembly.fibres", {"fibres n", ""}},
      {"assembly.fibre_length_um", {"fibre length L", "µm"}},
      {"assembly.fibre_height_um", {"fibre height l", "µm"}},
      {"assembly.orientation_deg", {"angle θ", "°", "θ"}},
      {"material.young_GPa", {"modulus E", "GPa"}},
      {"material.poisson", {"Poisson's ratio ν", ""}},
      {"material.density_kg_m3", {"density ρ", "kg/m³"}},
      {"material.viscosity_s", {"viscosity τ", "s"}},
      {"joints.head_tail_MPa", {"threshold σ₁", "MPa"}},
      {"joints.flank_MPa", {"threshold σ₂", "MPa"}},
      {"joints.resultant_MPa", {"resultant", "MPa"}},
      {"joints.head_tail_shear_MPa", {"head tail shear", "MPa"}},
      {"joints.flank_tension_MPa", {"flank tension", "MPa"}},
      {"joints.ratio", {"ratio r", ""}},
      {"joints.scatter", {"scatter d", ""}},
      {"joints.friction", {"friction μ", ""}},
      {"joints.missing", {"share of missing joints", ""}},
      {"loading.strain_rate_per_s", {"strain rate", "1/s"}},
      {"solver.step_s", {"step", "s"}}};
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  // Any other key is shown by its own name, in which its unit, if it has one, is spelled out.
  std::string name = key.substr(key.rfind('.') + 1);
  std::ranges::replace(name, '_', ' ');
  return {name, ""};
}

}  // namespace

std::string name_of_key(const std::string& key) {
  const KeyWords words = words_of(key);
  return words.unit.empty() ? words.name : fmt::format("{} ({})", words.name, words.unit);
}

std::string with_unit(const std::string& key, const std::string& value) {
  const std::string unit = words_of(key).unit;
  return typeset(value) + (unit.empty() || unit == "°" ? "" : "\u00a0") + unit;
}

std::string place(const std::string& key, const std::string& value) {
  return words_of(key).at_a_value + "\u00a0=\u00a0" + with_unit(key, value);
}

}  // namespace havers::reports
