#include "calib/porosity/scatter_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

constexpr double largest_scatter = 1.99;  // d < 2: no joint may start broken.

// What a section says, and the bone area by which that counts.
struct Share {
  double value, error, weight;
};

struct Pooled {
  double mean = 0.0;
  double standard_error = 0.0;
};

// Mean weighted by area, equally where an area is unknown. Its standard error is the larger of what
// the sections differ by and what each of them says of itself: few sections may agree by chance.
Pooled pool(std::vector<Share> shares) {
  const bool known = std::ranges::all_of(shares, [](const Share& one) { return one.weight > 0.0; });
  double area = 0.0, within = 0.0, between = 0.0;
  for (Share& one : shares) area += one.weight = known ? one.weight : 1.0;
  Pooled pooled;
  for (Share& one : shares) pooled.mean += (one.weight /= area) * one.value;
  for (const Share& one : shares) {
    within += std::pow(one.weight * one.error, 2);
    between += std::pow(one.weight * (one.value - pooled.mean), 2);
  }
  // (K1) Squares about their own mean are too small by the factor (n − 1)/n; a single section has
  // none.
  const auto n = static_cast<double>(shares.size());
  if (n > 1.0) between *= n / (n - 1.0);
  pooled.standard_error = std::sqrt(std::max(within, between));
  return pooled;
}

void pool_porosity(const std::vector<SectionPorosity>& sections, SpecimenPorosity& specimen) {
  std::vector<Share> shares;
  shares.reserve(sections.size());
  for (const SectionPorosity& section : sections)
    shares.push_back({section.porosity, section.porosity_standard_error, section.bone_area});
  const Pooled pooled = pool(shares);
  specimen.porosity = pooled.mean;
  specimen.porosity_standard_error = pooled.standard_error;
}

// (K1): the variance over the windows of all sections together, so that sections of different
// porosity widen it.
void pool_window_sd(const std::vector<SectionPorosity>& sections, SpecimenPorosity& specimen) {
  std::vector<Share> shares;
  for (const SectionPorosity& section : sections) {
    // Without a pixel size a section has no windows.
    if (!std::isfinite(section.window_sd)) continue;
    // The variance is pooled, with its error 2 SD se(SD); the root is taken at the end.
    const double variance =
        std::pow(section.window_sd, 2) + std::pow(section.porosity - specimen.porosity, 2);
    shares.push_back(
        {variance, 2.0 * section.window_sd * section.window_sd_standard_error, section.bone_area});
  }
  if (shares.empty()) {
    specimen.window_sd = std::numeric_limits<double>::quiet_NaN();
    specimen.window_sd_standard_error = specimen.window_sd;
    return;
  }
  const Pooled variance = pool(shares);
  specimen.window_sd = std::sqrt(variance.mean);
  if (specimen.window_sd > 0.0)
    specimen.window_sd_standard_error = variance.standard_error / (2.0 * specimen.window_sd);
}

// (K2) Σa²/Σa over the pores of all sections with a pixel size: a section's Σa² is its pore area
// times its a*. All sections have windows of one size.
void pool_pore_area_ratio(const std::vector<SectionPorosity>& sections,
                          SpecimenPorosity& specimen) {
  double area = 0.0, squares = 0.0;
  for (const SectionPorosity& section : sections) {
    if (!std::isfinite(section.pore_area)) continue;
    area += section.pore_area;
    squares += section.pore_area * section.pore_area_ratio;
    specimen.window_area = section.window_area;
  }
  if (area > 0.0) specimen.pore_area_ratio = squares / area;
}

// (K3) The scatter before it is held inside its bounds. NaN where nothing tells it.
double free_scatter(const SpecimenPorosity& porosity, const PorosityOptions& options) {
  switch (options.to_scatter) {
    case ToScatter::window:
      return std::sqrt(12.0) * options.strength_exponent * porosity.window_sd /
             (1.0 - porosity.porosity);
    case ToScatter::linear:
      return options.linear_offset + options.linear_slope * porosity.porosity;
    case ToScatter::none:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

SpecimenPorosity pool_sections(const std::vector<SectionPorosity>& sections) {
  assert(!sections.empty());
  SpecimenPorosity specimen;
  pool_porosity(sections, specimen);
  pool_window_sd(sections, specimen);
  pool_pore_area_ratio(sections, specimen);
  return specimen;
}

bool removes_joints(const SpecimenPorosity& porosity) {
  return porosity.window_area < porosity.pore_area_ratio;
}

double missing_joints(const SpecimenPorosity& porosity) {
  return removes_joints(porosity) ? porosity.porosity : 0.0;
}

double scatter_of(const SpecimenPorosity& porosity, const PorosityOptions& options) {
  assert(porosity.porosity >= 0.0 && porosity.porosity < 1.0);
  // A scatter that is NaN stays so.
  return std::clamp(free_scatter(porosity, options), 0.0, largest_scatter);
}

double scatter_standard_error(const SpecimenPorosity& porosity, const PorosityOptions& options) {
  // To first order, for the scatter before it is held: at a bound it is as uncertain.
  const double d = free_scatter(porosity, options);
  if (!std::isfinite(d)) return d;
  if (options.to_scatter == ToScatter::linear)
    return std::abs(options.linear_slope) * porosity.porosity_standard_error;
  const double solid = 1.0 - porosity.porosity;
  const double by_sd =
      std::sqrt(12.0) * options.strength_exponent / solid * porosity.window_sd_standard_error;
  // The windows' SD and the porosity are taken as independent.
  return std::hypot(by_sd, d / solid * porosity.porosity_standard_error);
}

double modulus_factor(const SpecimenPorosity& porosity, const PorosityOptions& options) {
  if (options.to_modulus == ToModulus::none) return 1.0;
  return std::pow(1.0 - porosity.porosity, options.modulus_exponent);
}

}  // namespace havers::calib
