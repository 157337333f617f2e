#include "reports/sweep/sweep_words.hpp"

#include <map>
#include <utility>

#include "reports/text/format.hpp"

namespace havers::reports {

std::string name_of_key(const std::string& key) {
  static const std::map<std::string, std::string> names{
      {"joints.scatter", "scatter d"},
      {"joints.ratio", "ratio r"},
      {"joints.missing", "share of missing joints"},
      {"joints.distribution", "distribution"},
      {"assembly.layers", "layers N"},
      {"assembly.fibres", "fibres n"},
      {"assembly.orientation_deg", "angle θ (°)"},
      {"material.viscosity_s", "viscosity τ (s)"},
      {"loading.strain_rate_per_s", "strain rate (1/s)"}};
  const auto found = names.find(key);
  return found == names.end() ? key.substr(key.rfind('.') + 1) : found->second;
}

std::string place(const std::string& key, const std::string& value) {
  static const std::map<std::string, std::pair<std::string, std::string>> with_unit{
      {"assembly.orientation_deg", {"θ", "°"}},
      {"material.viscosity_s", {"viscosity τ", "\u00a0s"}},
      {"loading.strain_rate_per_s", {"strain rate", "\u00a01/s"}}};
  const auto found = with_unit.find(key);
  const auto& [name, unit] =
      found == with_unit.end() ? std::pair{name_of_key(key), std::string()} : found->second;
  return name + "\u00a0=\u00a0" + typeset(value) + unit;
}

}  // namespace havers::reports
