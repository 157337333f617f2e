#include "calib/fit/model_checks.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "calib/count.hpp"
#include "calib/fit/specimen_effect.hpp"
#include "calib/fit/uncertainty.hpp"

namespace havers::calib {
namespace {

// A curve this much less straight than the model's was bent by something that the model does not
// have.
constexpr double bent = 0.90, slightly_bent = 0.97;

Check nothing_compared(const char* check) {
  return {check, Outcome::fail, "No simulation to compare with: nothing can be said."};
}

/// What the specimens of one orientation tell of a landmark.
struct Group {
  std::vector<Eigen::Index> rows;            // of the residuals
  std::vector<double> difference, variance;  // the latter without the specimen effect
};

// Of landmark q, by orientation [rad]. Strengths are left out for orientations where tests were
// stopped and the weaker specimens are those that broke (F25).
std::map<double, Group> groups_of(const FitProblem& problem, const Answer& answer, Eigen::Index q) {
  std::map<double, Group> groups;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    if (!tells(answer.best.predictions[f], problem.targets[s])[q]) continue;
    Group& group = groups[problem.study.specimens[s].orientation];
    group.rows.push_back(first_row(f) + q);
    group.difference.push_back(difference(answer.best.predictions[f], problem.targets[s])[q]);
    group.variance.push_back(variance_if_alike(answer.weights, s)[q]);
  }
  if (q == strength)
    for (const double orientation : one_sided_orientations(problem, answer.best))
      groups.erase(orientation);
  return groups;
}

// (F9) by what the specimens of an orientation differ among themselves.
double variance_within(const std::map<double, Group>& groups, double freedom) {
  Sample sample;
  for (const auto& [orientation, group] : groups) {
    const auto count = static_cast<double>(group.rows.size());
    const double mean = std::reduce(group.difference.begin(), group.difference.end()) / count;
    for (const double difference : group.difference) sample.difference.push_back(difference - mean);
    sample.variance.insert(sample.variance.end(), group.variance.begin(), group.variance.end());
  }
  return variance_between(sample, freedom);
}

// (F14) Probability of residuals between orientations as large as these if only specimens differed;
// nothing where none can be formed.
std::optional<double> chance(const FitProblem& problem, const Answer& answer, Eigen::Index q) {
  const auto groups = groups_of(problem, answer, q);
  double within = 0.0, between = static_cast<double>(groups.size());
  // Each orientation spends one degree of freedom on its mean.
  for (const auto& [orientation, group] : groups)
    within += static_cast<double>(group.rows.size()) - 1.0;
  if (within < least_freedom) return std::nullopt;
  const double own = variance_within(groups, within);

  // The answer by that variance, which a misfit between orientations does not widen.
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(answer.best.residuals.size());
  for (const auto& [orientation, group] : groups)
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
      const double before = group.variance[i] + std::pow(answer.weights.specimen[q], 2);
      factor[group.rows[i]] = std::sqrt(before / (group.variance[i] + own));
    }
  const auto [residuals, spent] = unfollowed(problem, answer, factor);
  for (const auto& [orientation, group] : groups) between -= spent(group.rows).sum();
  if (between < least_freedom) return std::nullopt;
  // n · mean² of each orientation; within them the variance is 1 by `own`.
  double squares = 0.0;
  for (const auto& [orientation, group] : groups)
    squares += std::pow(residuals(group.rows).sum(), 2) / static_cast<double>(group.rows.size());
  return gsl_cdf_fdist_Q(squares / between, between, within);
}

// Whether a fitted parameter moves the strengths; so, for all that is known, where slopes failed.
bool strengths_are_fitted(const FitProblem& problem, const Answer& answer) {
  if (answer.active.empty()) return false;
  if (answer.slopes.failed) return true;
  double squares = 0.0;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f)
    squares += answer.slopes.jacobian.row(first_row(f) + strength).squaredNorm();
  return squares > 0.0;
}

// Residuals that no parameter could move differ from nothing, perhaps all by the same.
std::string modulus_off(const FitProblem& problem, const Answer& answer, double p) {
  if (is_fitted(problem, answer, "young_GPa"))
    return fmt::format(
        "The modulus differs between orientations more than specimens do ({}); fibres of one "
        "modulus, bonded, do not. Set [calibrate.level] young_GPa = \"orientation\".",
        chance_text(p));
  return fmt::format(
      "The moduli are off the model's by more than specimens differ ({}), and young_GPa is not "
      "fitted: add it to calibrate.parameters, or give its value in [model.material].",
      chance_text(p));
}

std::string strength_off(const FitProblem& problem, const Answer& answer, double p) {
  if (strengths_are_fitted(problem, answer))
    return fmt::format(
        "The strength's residuals differ between orientations more than specimens do ({}): the "
        "model is rejected as it stands. See which orientation is off.",
        chance_text(p));
  return fmt::format(
      "The strengths are off the model's by more than specimens differ ({}), and no fitted "
      "parameter moves them: add head_tail_MPa to calibrate.parameters, or give its value in "
      "[model.joints].",
      chance_text(p));
}

}  // namespace

Unfollowed unfollowed(const FitProblem& problem, const Answer& answer,
                      const Eigen::VectorXd& factor) {
  Eigen::MatrixXd jacobian(factor.size(), 0);
  // Without slopes nothing is followed, and nothing spent.
  if (!answer.slopes.failed)
    jacobian = factor.asDiagonal() * free_columns(problem, answer.best.point, answer.asked.unknowns,
                                                  answer.asked.jacobian);
  const Eigen::VectorXd residuals = factor.cwiseProduct(answer.best.residuals);
  return {residuals - followed(jacobian, residuals), leverage(jacobian)};
}

bool same_record(const MeasuredTest& one, const MeasuredTest& other) {
  return !one.strain.empty() && one.strain == other.strain && one.max_force == other.max_force;
}

bool is_fitted(const FitProblem& problem, const Answer& answer, std::string_view parameter) {
  return std::ranges::any_of(
      answer.active, [&](Eigen::Index k) { return problem.unknown(k).info->name == parameter; });
}

std::string two_digits(double value) {
  constexpr double rounding = 1e-12;
  if (std::abs(value) < rounding) return "0";
  return value < 99.5 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

std::string percent_text(double part) {
  return two_digits(100.0 * part) + " %";
}

// No test is good enough for a smaller one.
std::string chance_text(std::optional<double> p) {
  if (!p) return "too few to tell";
  return *p < 1e-6 ? "p < 1e-6" : fmt::format("p = {:.2g}", *p);
}

std::string in_its_scale(const ParameterInfo& info) {
  return info.scale == Scale::logarithmic ? " in logarithms" : "";
}

Check check_brittle(const FitProblem& problem, const Answer& answer) {
  if (answer.best.failed || answer.best.predictions.empty()) return nothing_compared("brittle");
  double measured = 0.0, simulated = 0.0, variance = 0.0;
  double n = 0.0;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const Target& target = problem.targets[s];
    if (target.censored || answer.best.predictions[f].censored) continue;
    ++n;
    measured += target.value[linearity];
    simulated += answer.best.predictions[f].mean[linearity];
    variance += answer.weights.sd.empty() ? std::pow(target.noise[linearity], 2)
                                          : variance_if_alike(answer.weights, s)[linearity];
  }
  if (n == 0.0) return not_checked("brittle", "no test broke, or no simulation.");
  const double gap = (measured - simulated) / n, error = std::sqrt(variance) / n;
  const double part = std::exp(gap);
  const std::string numbers = fmt::format(
      "strength / (modulus × failure strain) is {:.2f} in the tests and {:.2f} in the model",
      std::exp(measured / n), std::exp(simulated / n));
  // What is certain is rejected where it is far off, and a warning where it is less so; what is not
  // certain passes, and the text says how far off would not.
  const bool certain = std::abs(gap) > 3.0 * error;
  // What is off is the model, where the tests are straight.
  const bool straight = std::abs(measured / n) < -std::log(slightly_bent);
  if (certain && (part < bent || part > 1.0 / bent))
    return {"brittle", Outcome::fail,
            fmt::format(
                "{} not brittle: {}. The model is rejected; its parameters describe nothing "
                "here.{}",
                straight ? "The tests are brittle, and the model's curves are" : "These curves are",
                numbers, straight ? " Is the scatter of its joints too large?" : "")};
  if (certain && (part < slightly_bent || part > 1.0 / slightly_bent))
    return {"brittle", Outcome::warn,
            fmt::format("{} before they break: {}. Strength is compared at the peak.",
                        straight     ? "The model's curves bend"
                        : part < 1.0 ? "The curves bend"
                                     : "The curves stiffen",
                        numbers)};
  if (straight && std::abs(simulated / n) < -std::log(slightly_bent))
    return {"brittle", Outcome::pass,
            fmt::format("The curves are straight up to the break: {}.", numbers)};
  if (certain)
    return {"brittle", Outcome::pass,
            fmt::format("The curves of tests and model bend alike up to the break: {}.", numbers)};
  return {"brittle", Outcome::pass,
          fmt::format("By how straight they are up to the break the curves of tests and model "
                      "cannot be told apart: {}. Tests {} below the model would reject it.",
                      numbers, percent_text(1.0 - std::min(bent, std::exp(-3.0 * error))))};
}

Check check_orientations(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "residuals unstructured";
  if (answer.best.failed || answer.weights.sd.empty()) return nothing_compared(name);
  const auto stiffness = chance(problem, answer, modulus);
  const auto breaking = chance(problem, answer, strength);
  if (!stiffness && !breaking)
    return not_checked(
        name, std::string("it takes more orientations than parameters, and two specimens at one") +
                  (one_sided_orientations(problem, answer.best).empty()
                       ? "."
                       : "; those where tests were stopped near their strength do not count, as at "
                         "most the weaker specimens broke."));
  if (stiffness && *stiffness < significance)
    return {name, Outcome::fail, modulus_off(problem, answer, *stiffness)};
  if (breaking && *breaking < significance)
    return {name, Outcome::fail, strength_off(problem, answer, *breaking)};
  return {name, Outcome::pass,
          fmt::format("Residuals do not differ between orientations (modulus: {}, strength: {}).",
                      chance_text(stiffness), chance_text(breaking))};
}

}  // namespace havers::calib
