// What of a scene can be run, and is hardly meant.
#include <fmt/format.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/scene.hpp"
#include "sim/simulate.hpp"

namespace havers::sim {

std::vector<std::string> Scene::doubts() const {
  constexpr double stiffest = 1.5e12;     // [Pa], beyond diamond
  constexpr double largest_strain = 0.2;  // the model is of small strains
  // Of head-tail joints and of flanks, which a large ratio makes weak: far below any bone's.
  constexpr double least_strain = 1e-5, least_of_flanks = 2e-6;
  // A modulus in another unit makes nonsense of all that is compared with it below.
  if (material.young > stiffest)
    return {fmt::format("material.young_GPa is {:.4g}, stiffer than any material: is it in GPa?",
                        material.young / 1e9)};
  std::vector<std::string> all;
  for (const auto& [key, threshold, least] :
       {std::tuple("head_tail_MPa", joints.head_tail, least_strain),
        {"flank_MPa", joints.flank, least_of_flanks}}) {
    const double strain = threshold / material.young;
    if (strain > largest_strain)
      all.push_back(fmt::format(
          "joints.{} is {:.4g}, {:.2g} times material.young_GPa: fibres would stretch by as much, "
          "and the model is of small strains; are both in their units?",
          key, threshold / 1e6, strain));
    if (strain < least)
      all.push_back(fmt::format(
          "joints.{} is {:.4g}, {:.2g} times material.young_GPa: bone bears hundreds of times as "
          "much; are both in their units?",
          key, threshold / 1e6, strain));
  }
  // Uniform motion starts with the stress Eτε̇.
  const double viscous = material.young * material.viscosity * loading.strain_rate;
  if (viscous > joints.head_tail && choose_regime(*this).regime == Regime::dynamic)
    all.push_back(fmt::format(
        "material.viscosity_s is {:.4g}: at {:g} /s it stresses the fibres by {:.2g} MPa at once, "
        "more than joints.head_tail_MPa; are it and the rate in seconds?",
        material.viscosity, loading.strain_rate, viscous / 1e6));
  if (solver.regime == Regime::quasi_static)
    for (const auto& [given, key] :
         {std::pair(material.viscosity > 0.0, "material.viscosity_s"),
          {loading.start == Start::rest, "loading.start"},
          {solver.step.has_value(), "solver.step_s"},
          {solver.contact == ContactMethod::gauss_seidel, "solver.contact"}})
      if (given)
        all.push_back(fmt::format(
            "{} changes nothing: solver.regime is quasi-static, and the limit has no time", key));
  return all;
}

}  // namespace havers::sim
