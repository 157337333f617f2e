#include "calib/fit/target.hpp"

#include <algorithm>
#include <cmath>

namespace havers::calib {
namespace {

// No testing machine knows force or strain better than this: ISO 7500-1 and ISO 9513 grade them in
// half percents.
constexpr double channel_class = 1e-3;

/// Change of strain and stress from one row to the next before the break; nothing where the peak is
/// smooth.
struct Row {
  double strain = 0.0;  // [-]
  double stress = 0.0;  // [Pa]
};

Row row_at_break(const MeasuredTest& test) {
  constexpr std::ptrdiff_t rows = 5;
  const auto peak = std::ranges::max_element(test.stress) - test.stress.begin();
  const auto count = std::ssize(test.stress);
  if (peak < rows || test.strain.size() != test.stress.size()) return {};
  const auto at = [&](std::ptrdiff_t i) { return static_cast<std::size_t>(i); };
  const double top = test.stress[at(peak)];
  // A specimen whose record ends at its peak, or falls by more than a tenth within a row, parted
  // between two rows.
  const bool abrupt = peak + 1 == count || test.stress[at(peak + 1)] < 0.9 * top;
  if (!abrupt) return {};
  return {.strain = std::max(test.strain[at(peak)] - test.strain[at(peak - rows)], 0.0) / rows,
          .stress = std::max(top - test.stress[at(peak - rows)], 0.0) / rows};
}

double squared(double x) {
  return x * x;
}

}  // namespace

Target target_of(const Specimen& specimen, const std::vector<std::string>& terms) {
  const MeasuredTest& test = specimen.test;
  Target target;
  target.present.setConstant(false);
  target.usable = test.modulus > 0.0 && test.strength > 0.0 && test.failure_strain > 0.0;
  if (!target.usable) return target;

  const Row row = specimen.broke ? row_at_break(test) : Row{};
  const double peak_stress = test.strength + 0.5 * row.stress;
  const double strain = test.failure_strain + 0.5 * row.strain;
  target.value = shape_of(test.strain, test.stress);
  target.value[modulus] = std::log(test.modulus);
  target.value[strength] = std::log(peak_stress);
  target.value[linearity] = std::log(peak_stress / (test.modulus * strain));

  const double by_modulus = squared(test.modulus_standard_error / test.modulus);
  const double by_strength =
      (squared(test.strength_standard_error) + squared(row.stress) / 12.0) / squared(peak_stress);
  const double by_strain = squared(row.strain / strain) / 12.0;
  const double by_end = by_strength + by_strain;
  Landmarks variance;
  // In the order of Landmark. Heights have half the relative error of the end, energy all of it.
  variance << by_modulus, by_strength, by_modulus + by_end, 0.25 * by_end, by_end, by_strain;
  variance += squared(channel_class);
  variance[modulus] += squared(channel_class);  // of both channels
  target.noise = variance.sqrt();
  target.censored = !specimen.broke;
  for (Eigen::Index q = 0; q < landmark_count; ++q)
    target.present[q] = std::ranges::find(terms, name_of(static_cast<Landmark>(q))) != terms.end();
  if (target.censored) target.present.tail<4>() = false;
  return target;
}

}  // namespace havers::calib
