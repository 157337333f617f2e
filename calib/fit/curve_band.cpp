#include "calib/fit/curve_band.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

constexpr int grid_points = 121;  // from no strain to the largest failure strain
constexpr double no_stress = std::numeric_limits<double>::quiet_NaN();  // beyond a curve's end

// Linear between rows; `beyond` after the last. Strains need not rise strictly: a break is a
// vertical step.
double stress_at(const std::vector<double>& strain, const std::vector<double>& stress, double at,
                 double beyond) {
  const auto next = std::ranges::lower_bound(strain, at);
  if (next == strain.end()) return beyond;
  const auto i = static_cast<std::size_t>(next - strain.begin());
  // Before the first row: on its line from the origin.
  if (i == 0) return strain[0] > 0.0 ? stress[0] * at / strain[0] : stress[0];
  const double width = strain[i] - strain[i - 1];
  const double part = width > 0.0 ? (at - strain[i - 1]) / width : 1.0;
  return stress[i - 1] + part * (stress[i] - stress[i - 1]);
}

double largest_strain(std::span<const Response> replicates, const MeasuredTest& measured) {
  double largest = measured.failure_strain;
  for (const auto& response : replicates)
    if (!response.failed) largest = std::max(largest, response.failure_strain);
  return largest;
}

}  // namespace

CurveBand band_of(std::span<const Response> replicates, const MeasuredTest& measured) {
  CurveBand band;
  const double end = largest_strain(replicates, measured);
  for (int i = 0; i < grid_points; ++i) {
    const double strain = end * i / (grid_points - 1);
    std::vector<double> stresses;
    // Beyond its end a replicate that broke bears nothing; of one that did not, nothing is known
    // there.
    for (const auto& response : replicates)
      if (!response.failed && !response.strain.empty())
        stresses.push_back(
            stress_at(response.strain, response.stress, strain, response.broke ? 0.0 : no_stress));
    std::erase_if(stresses, [](double stress) { return std::isnan(stress); });
    std::ranges::sort(stresses);
    const auto quantile = [&](double part) {
      if (stresses.empty()) return no_stress;
      return gsl_stats_quantile_from_sorted_data(stresses.data(), 1, stresses.size(), part);
    };
    const double measured_stress = stress_at(measured.strain, measured.stress, strain, no_stress);
    band.strain.push_back(strain);
    band.median.push_back(quantile(0.5));
    band.lower.push_back(quantile(0.025));
    band.upper.push_back(quantile(0.975));
    band.measured.push_back(measured_stress);
    band.residual.push_back(band.median.back() - measured_stress);
  }
  return band;
}

}  // namespace havers::calib
