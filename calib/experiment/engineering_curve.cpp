#include "calib/experiment/engineering_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "calib/count.hpp"

namespace havers::calib {
namespace {

// A record of fewer rows is refused.
constexpr std::size_t fewest_readings = 10;

// Width and thickness count before an area that the file gives. 0 where neither is known. [m²]
double area_of(const RawTest& raw) {
  if (raw.width && raw.thickness) return *raw.width * *raw.thickness;
  return raw.area.value_or(0.0);
}

// (X1)
void take_stress(const RawTest& raw, EngineeringCurve& curve) {
  curve.area = area_of(raw);
  if (!raw.force.empty() && curve.area > 0.0) {
    curve.stress.reserve(raw.force.size());
    for (const double force : raw.force) curve.stress.push_back(force / curve.area);
  } else if (!raw.stress.empty()) {
    curve.stress = raw.stress;
    curve.warnings.emplace_back(
        raw.force.empty() ? "no force was recorded: the machine's stress is used"
                          : "width and thickness are unknown: the machine's stress is used");
  } else if (raw.force.empty()) {
    curve.problems.emplace_back("neither force nor stress was recorded");
  } else {
    curve.problems.emplace_back("the cross-section is unknown: give width and thickness");
  }
}

// (X2) The crosshead's extension over the gauge length, or the column that the machine made of it,
// less what the machine gives way. Precondition: one of them is there.
void take_crosshead(const RawTest& raw, double machine_compliance, EngineeringCurve& curve) {
  const bool corrected = machine_compliance > 0.0 && !raw.force.empty() && raw.gauge_length;
  curve.strain.reserve(raw.rows());
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    const double machine = corrected ? machine_compliance * raw.force[i] / *raw.gauge_length : 0.0;
    curve.strain.push_back(
        (raw.strain.empty() ? raw.extension[i] / *raw.gauge_length : raw.strain[i]) - machine);
  }
  curve.of_crosshead = true;
  curve.machine_in_strain = !corrected;
  if (corrected)
    curve.corrections.push_back(
        {"machine compliance",
         fmt::format("{:.4g} mm per kN of force taken off the crosshead's extension",
                     machine_compliance * 1e6)});
  else
    curve.warnings.push_back(fmt::format(
        "{}, which contains the compliance of the machine; the modulus is too low by it",
        raw.fitted_strain ? "the gauge was fitted to the strain of the crosshead"
                          : "no strain of a gauge was read: strain is the crosshead's "
                            "extension over the gauge length"));
}

// A gauge's strain is taken as it is; one that comes from the crosshead is corrected or warned of.
void take_strain(const RawTest& raw, double machine_compliance, EngineeringCurve& curve) {
  const bool recorded = !raw.strain.empty();
  if (recorded && !raw.crosshead_strain)
    curve.strain = raw.strain;
  else if (!recorded && raw.extension.empty())
    curve.problems.emplace_back("neither strain nor crosshead extension was read");
  else if (!recorded && (!raw.gauge_length || *raw.gauge_length <= 0.0))
    curve.problems.emplace_back(
        "no strain was recorded, and the gauge length that would turn extension into strain is "
        "unknown");
  else
    take_crosshead(raw, machine_compliance, curve);
}

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

// Noise about zero is no tension, and what a load cell shows after the break no compression: the
// largest and the mean stress have to be negative together.
bool is_compressed(const std::vector<double>& stress) {
  const auto [low, high] = std::ranges::minmax(stress);
  return -low > high && std::accumulate(stress.begin(), stress.end(), 0.0) < 0.0;
}

// Whether the specimen is longer at the most negative load than at the first row. False where no
// elongation was recorded beside the load.
bool gets_longer(const std::vector<double>& elongation, const std::vector<double>& load) {
  if (elongation.size() != load.size()) return false;
  const auto largest = std::ranges::min_element(load) - load.begin();
  return elongation[static_cast<std::size_t>(largest)] > elongation.front();
}

}  // namespace

void turn_negative_load(RawTest& raw, bool stretched) {
  const std::vector<double>& elongation = raw.strain.empty() ? raw.extension : raw.strain;
  const char* turned = nullptr;
  for (const auto& [load, name] : {std::pair(&raw.stress, "stress"), {&raw.force, "force"}}) {
    if (load->empty() || !is_compressed(*load)) continue;
    // A specimen that does not get longer is compressed: its load stays negative, and is refused
    // later.
    if (!stretched && !gets_longer(elongation, *load)) continue;
    for (double& value : *load) value = -value;
    turned = name;
    raw.load_turned = true;
  }
  if (turned != nullptr)
    raw.warnings.push_back(
        fmt::format("the {} is negative while the specimen gets longer: it is taken as tension, "
                    "with its sign turned",
                    turned));
}

EngineeringCurve engineering_curve(const RawTest& raw, double machine_compliance) {
  assert(raw.force.empty() || raw.stress.empty() || raw.force.size() == raw.stress.size());
  assert(raw.strain.empty() || raw.strain.size() == raw.rows());
  assert(raw.extension.empty() || raw.extension.size() == raw.rows());
  EngineeringCurve curve;
  take_stress(raw, curve);
  take_strain(raw, machine_compliance, curve);
  if (!curve.problems.empty()) return curve;
  // Only the first complaint is made. Tension that was written negative has been turned before:
  // what is negative here is compression.
  if (raw.rows() < fewest_readings)
    curve.problems.push_back(
        fmt::format("{} {} too few", count(raw.rows(), "row"), raw.rows() == 1 ? "is" : "are"));
  else if (!all_finite(curve.stress) || !all_finite(curve.strain) || !all_finite(raw.time))
    curve.problems.emplace_back("a number is not finite");
  else if (is_compressed(curve.stress))
    curve.problems.push_back(
        fmt::format("the {} is negative, as in compression, down to {:.4g} MPa, and the specimen "
                    "gets no longer: only tension can be used; where the file counts tension "
                    "negative, change the signs of its columns",
                    raw.force.empty() || curve.area <= 0.0 ? "stress" : "force",
                    std::ranges::min(curve.stress) * 1e-6));
  else if (std::ranges::max(curve.stress) <= 0.0)
    curve.problems.emplace_back("the specimen is never under tension");
  return curve;
}

}  // namespace havers::calib
