#include "calib/study/parameter.hpp"

#include <algorithm>
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

}  // namespace

const std::vector<ParameterInfo>& all_parameters() {
  static const std::vector<ParameterInfo> table{
      {"young_GPa", "E", "GPa", 1.0, 60.0, Scale::logarithmic, "Young's modulus of the fibres."},
      {"head_tail_MPa", "σ₁", "MPa", 1.0, 1000.0, Scale::logarithmic,
       "Mean stress that breaks a head-tail joint."},
      {"ratio", "r", "", 0.1, 20.0, Scale::logarithmic,
       "Force that breaks a head-tail joint over the force that breaks a flank joint."},
      {"scatter", "d", "", 0.01, 1.9, Scale::linear,
       "Length of the interval from which a joint's threshold is drawn, over its mean."},
  };
  return table;
}

const ParameterInfo* find_parameter(std::string_view name) {
  const auto& table = all_parameters();
  const auto found = std::ranges::find(table, name, &ParameterInfo::name);
  return found == table.end() ? nullptr : &*found;
}

void apply(sim::Scene& scene, std::string_view name, double value) {
  assert(find_parameter(name));
  if (name == "young_GPa") scene.material.young = value * 1e9;
  if (name == "head_tail_MPa") scale_thresholds(scene.joints, value * 1e6 / scene.joints.head_tail);
  if (name == "ratio")
    scene.joints.flank = sim::flank_from_ratio(scene.assembly, scene.joints.head_tail, value);
  if (name == "scatter") scene.joints.scatter = value;
}

double value_of(const sim::Scene& scene, std::string_view name) {
  assert(find_parameter(name));
  if (name == "young_GPa") return scene.material.young / 1e9;
  if (name == "head_tail_MPa") return scene.joints.head_tail / 1e6;
  if (name == "ratio") return sim::ratio(scene.assembly, scene.joints);
  return scene.joints.scatter;
}

}  // namespace havers::calib
