// The check of how much specimens differ, and what chance would have of it if they were alike.
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "calib/fit/model_checks.hpp"
#include "calib/fit/specimen_effect.hpp"
#include "calib/fit/uncertainty.hpp"

namespace havers::calib {
namespace {

// Which strengths χ² is without.
std::string left_out_text(const std::set<double>& one_sided) {
  if (one_sided.empty()) return "";
  std::vector<double> degrees;
  degrees.reserve(one_sided.size());
  for (const double orientation : one_sided) degrees.push_back(orientation / degree);
  return fmt::format("; strengths at {:.4g} deg are left out of it, as tests were stopped there",
                     fmt::join(degrees, ", "));
}

/// Residuals of one landmark at one orientation as they would be if specimens were alike.
struct AlikeGroup {
  double squares = 0.0, freedom = 0.0;
  double replicates = 0.0;  // part of the variance that the replicates' spread makes, × freedom
  double known = 0.0;       // degrees of freedom of that spread

  // χ² of the chance that an F test gives them, as the replicates are few.
  [[nodiscard]] double chi_squared() const {
    const double part = replicates / freedom;
    // Where the variance is as good as known, the F test is a χ² test.
    const double chance = part * part < 1e-6 * known
                              ? gsl_cdf_chisq_Q(squares, freedom)
                              : gsl_cdf_fdist_Q(squares / freedom, freedom, known / (part * part));
    return gsl_cdf_chisq_Qinv(std::max(chance, 1e-300), freedom);
  }
};

// (F9) without a specimen effect, and with the answer moved to where that puts it: by landmark and
// orientation.
std::map<std::pair<Eigen::Index, double>, AlikeGroup> alike_groups(
    const FitProblem& problem, const Answer& answer, const std::set<double>& one_sided) {
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(answer.best.residuals.size());
  std::vector<Landmarks> part(problem.fitted.size(), Landmarks::Zero());
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const auto& weights = answer.weights;
    const Landmarks alike = variance_if_alike(weights, s).sqrt();
    // From residuals by s with τ to those by s without it.
    factor.segment<landmark_count>(first_row(f)) =
        tells(answer.best.predictions[f], problem.targets[s]).select(weights.sd[s] / alike, 1.0);
    part[f] = (weights.replicates[s] / alike).square();
  }
  const auto [residuals, spent] = unfollowed(problem, answer, factor);

  std::map<std::pair<Eigen::Index, double>, AlikeGroup> groups;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const double orientation = problem.study.specimens[problem.fitted[f]].orientation;
    const auto& prediction = answer.best.predictions[f];
    auto told = tells(prediction, problem.targets[problem.fitted[f]]);
    if (one_sided.contains(orientation)) told[strength] = false;
    for (Eigen::Index q = 0; q < landmark_count; ++q) {
      AlikeGroup& group = groups[{q, orientation}];
      // The spread is pooled (F6): replicates of specimens that tell nothing here count too.
      group.known += std::max(prediction.usable - 1, 1);
      if (!told[q]) continue;
      const Eigen::Index row = first_row(f) + q;
      group.squares += residuals[row] * residuals[row];
      group.freedom += 1.0 - spent[row];
      group.replicates += (1.0 - spent[row]) * part[f][q];
    }
  }
  return groups;
}

// Where specimens differ too much for a model of one bone, that is what rejects it.
std::string chi_squared_sentence(const FitProblem& problem, const Answer& answer, bool rejected) {
  constexpr double least_of_group = 0.1;  // what has less was followed
  if (answer.best.failed || answer.weights.sd.empty()) return "";
  if (answer.slopes.failed && !answer.active.empty()) return "";
  const auto one_sided = one_sided_orientations(problem, answer.best);
  double sum = 0.0, freedom = 0.0;
  for (const auto& [where, group] : alike_groups(problem, answer, one_sided)) {
    if (group.freedom < least_of_group) continue;
    sum += group.chi_squared();
    freedom += group.freedom;
  }
  if (freedom < 1.0) return "";
  const double chance = gsl_cdf_chisq_Q(sum, freedom);
  const bool unlike = chance < significance && !answer.active.empty();
  const std::string degrees = fmt::format("{:.3g}", freedom);
  return fmt::format(" Were they alike, χ² would be {:.3g} on {} degree{} of freedom ({}){}{}.",
                     sum, degrees, degrees == "1" ? "" : "s", chance_text(chance),
                     !unlike    ? ""
                     : rejected ? ": they are not"
                                : ": they are not, which widens the intervals and rejects nothing",
                     left_out_text(one_sided));
}

/// Of which landmarks the specimens' differences are told, and of which they cannot be (F9).
struct SpreadWords {
  std::vector<std::string> told;
  std::string untold;
};

SpreadWords spread_words(const FitProblem& problem, const Answer& answer) {
  SpreadWords words;
  for (const auto& [q, one, many] :
       {std::tuple(modulus, "modulus", "moduli"), std::tuple(strength, "strength", "strengths")}) {
    const auto counts = [&, q = q](std::size_t s) { return problem.targets[s].present[q]; };
    if (std::ranges::none_of(problem.fitted, counts)) continue;
    if (answer.slopes.failed || answer.uncertainty.freedom[q] >= least_freedom) {
      words.told.push_back(fmt::format("{} in {}", percent_text(answer.weights.specimen[q]), one));
      continue;
    }
    const double count = residuals_told(problem, answer.best)[q];
    const auto spent = fmt::format("{:.2g}", count - answer.uncertainty.freedom[q]);
    words.untold += fmt::format(
        " {:g} {} for {} parameter{}: whether specimens differ in {} cannot be told, and the "
        "intervals do not include it.",
        count, count == 1.0 ? one : many, spent, spent == "1" ? "" : "s", one);
  }
  return words;
}

}  // namespace

Check check_specimen_spread(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "spread between specimens";
  const bool few = problem.fitted.size() < 3, no_interval = answer.slopes.failed;
  if (few && no_interval)
    return {
        name, Outcome::warn,
        "Fewer than three specimens: how much they differ beyond noise is not told. Test more."};
  const Landmarks& part = answer.weights.specimen;
  const auto [told, untold] = spread_words(problem, answer);
  const double most = std::max(part[modulus], part[strength]);
  const bool rejected = !few && !told.empty() && most > 0.5;
  const auto rest =
      untold + chi_squared_sentence(problem, answer, rejected) + (few ? " Test more." : "");
  if (told.empty() && untold.empty())
    return not_checked(name, "neither modulus nor strength is compared.");
  if (told.empty()) return {name, Outcome::warn, rest.substr(1)};
  const auto text = fmt::format(
      "Specimens differ by {} (standard deviations) beyond noise, scatter and the model's own "
      "randomness",
      fmt::join(told, " and "));
  if (few)
    return {name, Outcome::warn,
            text + "; the intervals include it, as far as so few tell it." + rest};
  if (rejected)
    return {name, Outcome::fail,
            text + ": no model of one bone describes them. Are tests, sizes or angles exchanged?" +
                rest};
  if (most > 0.3)
    return {name, Outcome::warn,
            text + ": are they of one kind?" + (no_interval ? "" : " The intervals include it.") +
                rest};
  return {name, untold.empty() ? Outcome::pass : Outcome::warn,
          text + (no_interval ? "." : "; the intervals include it.") + rest};
}

}  // namespace havers::calib
