// (F19) Laws without fibres, fitted to log strengths by least squares and compared with the model
// by their criterion; (F23) Weibull's modulus.
#include "calib/fit/plain_law.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace havers::calib {
namespace {

using Eigen::Index;

/// A law as the columns of its design matrix.
struct LawDesign {
  std::string name;
  Eigen::MatrixXd columns;
};

// Columns: one constant per orientation; then d, shared or per orientation.
std::vector<LawDesign> designs_of(std::span<const Broken> specimens) {
  std::map<double, Index> groups;
  for (const Broken& one : specimens) groups.emplace(one.orientation, 0);
  Index next = 0;
  for (auto& [orientation, column] : groups) column = next++;

  const auto n = static_cast<Index>(specimens.size());
  Eigen::MatrixXd strength = Eigen::MatrixXd::Zero(n, next), slope = strength;
  Eigen::VectorXd scatter(n);
  for (Index i = 0; i < n; ++i) {
    const Broken& one = specimens[static_cast<std::size_t>(i)];
    strength(i, groups[one.orientation]) = 1.0;
    slope(i, groups[one.orientation]) = one.scatter;
    scatter[i] = one.scatter;
  }
  std::vector<LawDesign> designs{{"one strength per orientation", strength}};
  designs.push_back({"one strength per orientation, falling with the scatter", {}});
  designs.back().columns.resize(n, next + 1);
  designs.back().columns << strength, scatter;
  designs.push_back({"strength and slope per orientation", {}});
  designs.back().columns.resize(n, 2 * next);
  designs.back().columns << strength, slope;
  return designs;
}

}  // namespace

double strength_by(std::span<const SweepLaw> laws, const Broken& specimen) {
  constexpr double same_angle = 0.5 * degree;  // at another one a law says nothing
  const SweepLaw* nearest = nullptr;
  double distance = std::numeric_limits<double>::infinity();
  for (const SweepLaw& law : laws) {
    double away = 0.0;
    if (law.per == "assembly.orientation_deg")
      // A wall at −θ is that at θ in a mirror.
      away = std::abs(std::abs(law.at * degree) - std::abs(specimen.orientation));
    else if (law.per == "joints.ratio")
      away = std::abs(std::log(law.at / specimen.ratio));
    if (away >= distance || (law.per == "assembly.orientation_deg" && away > same_angle)) continue;
    nearest = &law;
    distance = away;
  }
  if (nearest == nullptr) return std::numeric_limits<double>::quiet_NaN();
  // The constant comes last.
  double strength = nearest->coefficients.back();
  for (std::size_t i = 0; i < nearest->terms.size(); ++i)
    strength += nearest->coefficients[i] *
                (nearest->terms[i] == "joints.ratio" ? specimen.ratio : specimen.scatter);
  return strength;
}

double aicc(double sum_of_squares, double specimens, double parameters) {
  const double k = parameters + 1.0;
  // The correction has no meaning with so few.
  if (specimens - k - 1.0 < 0.5) return std::numeric_limits<double>::infinity();
  constexpr double least_error = 1e-3;  // of the best class of machines (F5)
  const double square = std::max(sum_of_squares / specimens, least_error * least_error);
  return specimens * std::log(square) + 2.0 * k + 2.0 * k * (k + 1.0) / (specimens - k - 1.0);
}

PlainLaw best_plain_law(std::span<const Broken> specimens, double model_parameters,
                        std::span<const SweepLaw> laws) {
  const auto n = static_cast<double>(specimens.size());
  Eigen::VectorXd strength(static_cast<Index>(specimens.size()));
  double by_model = 0.0;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    strength[static_cast<Index>(i)] = specimens[i].strength;
    by_model += std::pow(specimens[i].strength - specimens[i].model, 2);
  }
  PlainLaw best{.criterion = std::numeric_limits<double>::infinity(),
                .model_criterion = aicc(by_model, n, model_parameters)};
  for (const LawDesign& design : designs_of(specimens)) {
    const auto qr = design.columns.colPivHouseholderQr();
    const double left = (design.columns * qr.solve(strength) - strength).squaredNorm();
    // Parameters are counted by rank: where all specimens of an orientation have one scatter, a
    // slope in it is no further parameter.
    const double criterion = aicc(left, n, static_cast<double>(qr.rank()));
    if (criterion < best.criterion) {
      best.name = design.name;
      best.criterion = criterion;
    }
  }
  Eigen::VectorXd off(strength.size());  // by the sweep's laws; their factor is the mean
  for (Index i = 0; i < off.size(); ++i)
    off[i] = strength[i] - std::log(strength_by(laws, specimens[static_cast<std::size_t>(i)]));
  best.laws_compared = !laws.empty() && off.allFinite();
  if (best.laws_compared) {
    const double criterion = aicc((off.array() - off.mean()).matrix().squaredNorm(), n, 1.0);
    if (criterion < best.criterion) best.name = "the sweep's laws times a factor";
    best.criterion = std::min(best.criterion, criterion);
  }
  return best;
}

// The likelihood's slope falls with m: bisection in log m.
Weibull weibull(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  // Values over the largest one: their powers are 1 at the most, however large m is.
  const double largest = *std::ranges::max_element(values);
  double mean_log = 0.0;
  for (const double x : values) mean_log += std::log(x / largest) / n;
  const auto slope = [&](double m) {
    double sum = 0.0, weighted = 0.0;
    for (const double x : values) {
      const double power = std::pow(x / largest, m);
      sum += power;
      weighted += power * std::log(x / largest);
    }
    return 1.0 / m + mean_log - weighted / sum;
  };
  double low = std::log(1e-2), high = std::log(1e6);
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(std::exp(middle)) > 0.0 ? low : high) = middle;
  }
  const double modulus = std::exp(low);
  // (F23) Quantiles of the true modulus.
  const auto quantile = [&](double part) {
    constexpr double c = std::numbers::pi * std::numbers::pi / 12.0;
    return modulus * std::sqrt(gsl_cdf_chisq_Pinv(part, c * (n - 1.0)) / (c * n));
  };
  return {modulus, quantile(0.5), {quantile(0.025), quantile(0.975)}};
}

}  // namespace havers::calib
