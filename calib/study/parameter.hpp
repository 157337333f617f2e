// The model quantities that can be calibrated, declared once for reader, validator, help and
// report.
#pragma once

#include <string_view>
#include <vector>

#include "calib/porosity/scatter_map.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

/// How a parameter is searched: in its logarithm or as it is.
enum class Scale { logarithmic, linear };

/// One calibratable quantity. Values are in `unit`, as in the input files; `apply` converts to SI.
struct ParameterInfo {
  std::string_view name;    ///< Key in a study, e.g. "head_tail_MPa".
  std::string_view symbol;  ///< As in the theory, e.g. "σ₁".
  std::string_view unit;    ///< "GPa", "MPa", "" for dimensionless.
  double lower, upper;      ///< Default bounds, in `unit`.
  Scale scale;
  std::string_view meaning;  ///< One sentence.
  bool automatic = false;    ///< Tried by parameters = "auto".
  bool of_porosity = false;  ///< Of the laws of porosity, not of the scene.
};

/// All of them, in the order of the documentation: young_GPa, head_tail_MPa, ratio, scatter, then
/// every other number of [material] and [joints], the fibres' aspect ratio, the laws of porosity.
const std::vector<ParameterInfo>& all_parameters();

/// The one of that name, or null.
const ParameterInfo* find_parameter(std::string_view name);

/// Sets a parameter in a scene. `ratio` keeps σ₁ and sets σ₂; `head_tail_MPa`, `resultant_MPa` and
/// `aspect_ratio` keep the ratio; the last sets the fibres' length. One of porosity changes
/// nothing.
void apply(sim::Scene& scene, std::string_view name, double value);

/// Its value in a scene, in `unit`. Precondition: not one of porosity.
double value_of(const sim::Scene& scene, std::string_view name);

/// The same for the laws of porosity; a parameter of the scene changes nothing.
void apply(PorosityOptions& laws, std::string_view name, double value);
double value_of(const PorosityOptions& laws, std::string_view name);

}  // namespace havers::calib
