// The check of how much specimens differ, and what chance would have of it if they were alike.
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "calib/count.hpp"
#include "calib/fit/model_checks.hpp"
#include "calib/fit/specimen_effect.hpp"

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

// (F9) without a specimen effect: what the residuals would be if specimens were alike. Where they
// differ too much for a model of one bone, that is what rejects it.
std::string chi_squared_sentence(const FitProblem& problem, const Answer& answer, bool rejected) {
  if (answer.best.failed || answer.weights.sd.empty()) return "";
  const auto one_sided = one_sided_orientations(problem, answer.best);
  double sum = 0.0, terms = 0.0;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const Landmarks alike =
        (answer.weights.sd[s].square() - answer.weights.specimen.square()).sqrt();
    const auto& prediction = answer.best.predictions[f];
    auto told = tells(prediction, problem.targets[s]);
    if (one_sided.contains(problem.study.specimens[s].orientation)) told[strength] = false;
    sum += told.select(difference(prediction, problem.targets[s]) / alike, 0.0).square().sum();
    terms += static_cast<double>(told.count());
  }
  const double freedom = terms - static_cast<double>(answer.active.size());
  if (freedom < 1.0) return "";
  const double chance = gsl_cdf_chisq_Q(sum, freedom);
  const bool unlike = chance < significance && !answer.active.empty();
  return fmt::format(" Were they alike, χ² would be {:.3g} on {} of freedom ({}){}{}.", sum,
                     count(static_cast<long>(freedom), "degree"), chance_text(chance),
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
  const bool few = problem.fitted.size() < 3;
  if (few && answer.slopes.failed)
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
    return {name, Outcome::pass, "Not checked: neither modulus nor strength is compared.", false};
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
            text + ": are they of one kind?" +
                (answer.active.empty() ? "" : " The intervals include it.") + rest};
  return {name, untold.empty() ? Outcome::pass : Outcome::warn,
          text + "; the intervals include it." + rest};
}

}  // namespace havers::calib
