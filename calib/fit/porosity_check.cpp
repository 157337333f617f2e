#include "calib/fit/porosity_check.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calib/fit/model_checks.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;

// Student's test of the line's slope, the level and the parameters refitted, if specimens differ by
// a variance `between`. It is exact where they do, whatever the scale of all variances is.
std::optional<PorosityTrend> trend_if(const PorositySample& sample, double between) {
  constexpr double least_slope = 1e-3;  // of the steepest: what is flatter makes up for nothing
  constexpr double least_left = 0.1;    // of the porosities' differences
  const Index n = sample.difference.size();
  const Eigen::VectorXd weight = (sample.variance.array() + between).rsqrt();
  Eigen::MatrixXd known(n, 1 + sample.slopes.cols());
  known << Eigen::VectorXd::Ones(n), sample.slopes;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(least_slope);
  qr.compute(weight.asDiagonal() * known);
  const Index freedom = n - qr.rank() - 1;
  if (freedom < 1) return std::nullopt;

  // Weighted values, less what level and parameters can follow of them.
  const auto left_of = [&](const Eigen::VectorXd& values) {
    Eigen::VectorXd turned = qr.householderQ().adjoint() * weight.cwiseProduct(values);
    return Eigen::VectorXd(turned.tail(n - qr.rank()));
  };
  const Eigen::VectorXd from_mean = sample.porosity.array() - sample.porosity.mean();
  const Eigen::VectorXd x = left_of(from_mean), y = left_of(sample.difference);
  if (!(x.norm() > least_left * weight.cwiseProduct(from_mean).norm())) return std::nullopt;
  const double slope = x.dot(y) / x.squaredNorm();
  double variance = (y - slope * x).squaredNorm() / static_cast<double>(freedom);
  // Without a difference between specimens the variances are known: none is smaller.
  variance = std::max(variance, between > 0.0 ? std::numeric_limits<double>::min() : 1.0);
  const double t = std::abs(slope) * x.norm() / std::sqrt(variance);
  return PorosityTrend{slope, 2.0 * gsl_cdf_tdist_Q(t, static_cast<double>(freedom))};
}

// What the fitted specimens of known porosity tell of a landmark.
PorositySample sample_of(const FitProblem& problem, const Answer& answer, Landmark q) {
  const auto one_sided =
      q == strength ? one_sided_orientations(problem, answer.best) : std::set<double>{};
  std::vector<std::size_t> rows;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    if (tells(answer.best.predictions[f], problem.targets[s])[q] &&
        std::isfinite(problem.models[s].porosity) &&
        !one_sided.contains(problem.study.specimens[s].orientation))
      rows.push_back(f);
  }
  const auto n = static_cast<Index>(rows.size());
  PorositySample sample{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                        Eigen::MatrixXd(n, answer.slopes.jacobian.cols())};
  for (Index i = 0; i < n; ++i) {
    const std::size_t f = rows[static_cast<std::size_t>(i)], s = problem.fitted[f];
    const double sd = answer.weights.sd[s][q];
    sample.difference[i] = difference(answer.best.predictions[f], problem.targets[s])[q];
    sample.variance[i] = variance_if_alike(answer.weights, s)[q];
    sample.porosity[i] = problem.models[s].porosity;
    // Slopes of the difference itself: the Jacobian is that of residuals, which are divided by s.
    sample.slopes.row(i) = sd * answer.slopes.jacobian.row(first_row(f) + q);
  }
  return sample;
}

/// How a study says what porosity does to a landmark.
struct PorosityLaw {
  std::string_view landmark;  // in the plural
  bool used = false;
  std::string_view none, one;  // settings without a law, and with one
  std::string_view exponent;   // of the one that is used
};

PorosityLaw porosity_law(const PorosityOptions& options, Landmark q) {
  if (q == modulus)
    return {.landmark = "moduli",
            .used = options.to_modulus != ToModulus::none,
            .none = "porosity.to_modulus = \"none\"",
            .one = "porosity.to_modulus = \"power\"",
            .exponent = "modulus_exponent"};
  return {
      .landmark = "strengths",
      .used = options.to_scatter != ToScatter::none,
      .none = "porosity.to_scatter = \"none\"",
      .one = "porosity.to_scatter = \"window\"",
      .exponent = options.to_scatter == ToScatter::window ? "strength_exponent" : "linear_slope"};
}

std::string law_advice(const PorosityLaw& law, double slope) {
  if (law.used)
    return fmt::format(
        "the law of porosity is not that of these specimens. Leave it out ({}), or take another "
        "{}, which can be calibrated too.",
        law.none, law.exponent);
  if (slope > 0.0)
    return fmt::format("porosity explains what the model does not. Give it a law ({}).", law.one);
  return "no law of porosity does that. Are sections exchanged between specimens?";
}

std::string trend_sentence(const PorosityLaw& law, const PorosityTrend& trend) {
  return fmt::format(
      "Against the measured ones the simulated {} {} by {} for each percent of porosity ({}): {}",
      law.landmark, trend.slope < 0.0 ? "fall" : "rise",
      percent_text(std::abs(std::expm1(0.01 * trend.slope))), chance_text(trend.chance),
      law_advice(law, trend.slope));
}

}  // namespace

// How much specimens differ is not known: what they may differ by to make the slope likeliest
// rejects no more true models than are meant.
std::optional<PorosityTrend> porosity_trend(const PorositySample& sample) {
  constexpr int steps = 24;                    // through magnitudes of what specimens may differ by
  constexpr double below = 0.1, above = 10.0;  // of the smallest and largest standard deviation
  if (sample.difference.size() < 3) return std::nullopt;
  auto likeliest = trend_if(sample, 0.0);
  const double low = below * std::sqrt(sample.variance.minCoeff());
  const double high = above * std::sqrt(sample.variance.maxCoeff());
  for (int i = 0; likeliest && i <= steps; ++i) {
    const double between = low * std::pow(high / low, static_cast<double>(i) / steps);
    const auto trend = trend_if(sample, between * between);
    if (!trend || trend->chance > likeliest->chance) likeliest = trend;
  }
  return likeliest;
}

Check check_porosity(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "residuals and porosity";
  if (answer.best.failed || answer.weights.sd.empty() || answer.slopes.failed)
    return not_checked(name, "there is nothing to compare by.");
  const auto stiffness = porosity_trend(sample_of(problem, answer, modulus));
  const auto breaking = porosity_trend(sample_of(problem, answer, strength));
  if (!stiffness && !breaking)
    return not_checked(
        name,
        "it takes more specimens of known porosity than parameters, two at least, and porosities "
        "that differ beside what the parameters make up for.");
  // Two looks at half the level are one at the whole.
  const double level = stiffness && breaking ? 0.5 * significance : significance;
  std::string text;
  for (const auto& [trend, q] : {std::pair(stiffness, modulus), std::pair(breaking, strength)})
    if (trend && trend->chance < level)
      text += (text.empty() ? "" : " ") +
              trend_sentence(porosity_law(problem.study.porosity, q), *trend);
  if (!text.empty()) return {name, Outcome::fail, text};
  const auto words = [](const std::optional<PorosityTrend>& trend) {
    return chance_text(trend ? std::optional(trend->chance) : std::nullopt);
  };
  return {name, Outcome::pass,
          fmt::format("Residuals do not follow porosity (modulus: {}, strength: {}).",
                      words(stiffness), words(breaking))};
}

}  // namespace havers::calib
