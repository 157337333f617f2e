#include "calib/fit/answer_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "calib/count.hpp"
#include "calib/fit/left_out.hpp"
#include "calib/fit/model_checks.hpp"
#include "calib/fit/plain_law.hpp"
#include "calib/fit/specimen_effect.hpp"

namespace havers::calib {
namespace {

Check not_fitted(const char* check) {
  return not_checked(check, "no parameter was fitted with an interval.");
}

// In the scale of the search (F1), where intervals are symmetric.
double width(const ParameterInfo& info, const std::array<double, 2>& interval) {
  return to_search(info, interval[1]) - to_search(info, interval[0]);
}

// Where a profile has no end though that of the slopes is inside the bounds.
const char* open_side(const CalibratedParameter& parameter) {
  if (std::isnan(parameter.profile_95[0]) && parameter.slopes_95[0] > parameter.bounds[0])
    return "below";
  if (std::isnan(parameter.profile_95[1]) && parameter.slopes_95[1] < parameter.bounds[1])
    return "above";
  return nullptr;
}

// A draw of few specimens may lack those that tell a parameter, which the slopes do not know.
std::string wider_bootstraps(const FitProblem& problem, const CalibrationResult& result) {
  std::vector<std::string> wider;
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    const CalibratedParameter& parameter = result.parameters[k];
    const ParameterInfo& info = *problem.unknowns[k].info;
    const double part = width(info, parameter.bootstrap_95) / width(info, parameter.interval_95);
    if (std::isfinite(part) && part > 1.5)
      wider.push_back(fmt::format("{} ({} times as wide{})", parameter.name, two_digits(part),
                                  in_its_scale(info)));
  }
  if (wider.empty()) return "";
  return fmt::format(
      " The bootstrap over specimens gives wider ones: {}; a draw may leave out "
      "the few specimens that tell a parameter.",
      fmt::join(wider, ", "));
}

// "1.40", or "0.95 to 1.40".
std::string times_text(double least, double most) {
  const std::string low = fmt::format("{:.2f}", least), high = fmt::format("{:.2f}", most);
  return low == high ? low : fmt::format("{} to {}", low, high);
}

}  // namespace

Check check_randomness(const CalibrationResult& result) {
  constexpr const char* name = "fresh seeds";
  constexpr double other_width = 2.0;  // times as wide or as narrow (F17)
  const Randomness& r = result.randomness;
  if (result.fitted.empty()) return not_fitted(name);
  if (!std::isfinite(r.fresh_shift))
    return {name, Outcome::warn,
            "Simulations with fresh seeds failed: the answer rests on its own."};
  // Where common seeds cancel altogether the gain is infinite, and nothing is said of it.
  const std::string gain =
      std::isfinite(r.common_gain) && r.common_gain < 1.5
          ? " Common random numbers bring nothing here: replicates answer a change each in its own "
            "way."
      : std::isfinite(r.common_gain)
          ? fmt::format(
                " Common random numbers make differences between points {:.3g} times less noisy.",
                r.common_gain)
          : "";
  const std::string numbers = fmt::format(
      "{} fresh seeds per specimen move no parameter by more than {} standard errors, the "
      "interval that changes most is {} times as wide, their cost is {:.3g}; the replicates' "
      "chance makes {} of the variance.{}",
      r.replicates, two_digits(r.fresh_shift), two_digits(r.fresh_width), r.fresh_cost,
      percent_text(r.simulator_share), gain);
  const bool as_wide = r.fresh_width <= other_width && r.fresh_width >= 1.0 / other_width;
  if (r.fresh_shift <= 1.0 && r.simulator_share <= 0.5 && as_wide)
    return {name, Outcome::pass, numbers};
  return {name, Outcome::warn,
          numbers + fmt::format(" Raise calibrate.options.replicates to {}.",
                                std::max(r.replicates_needed, 2 * r.replicates))};
}

Check check_confirmation(const FitProblem& problem, const CalibrationResult& result) {
  constexpr const char* name = "confirmed in time";
  constexpr double close = 0.02;  // part by which strength and failure strain may differ
  if (problem.study.calibrate.confirm > 0 && result.fitted.empty()) return not_fitted(name);
  double strength = 0.0, strain = 0.0, wave = 0.0;
  std::size_t compared = 0;
  for (const Confirmation& one : result.confirmations) {
    if (one.failed) continue;
    ++compared;
    strength = std::max(strength, std::abs(one.strength_in_time / one.strength_limit - 1.0));
    strain =
        std::max(strain, std::abs(one.failure_strain_in_time / one.failure_strain_limit - 1.0));
    wave = std::max(wave, one.peak_in_time / one.strength_in_time - 1.0);
  }
  if (result.confirmations.empty())
    return not_checked(
        name, problem.study.calibrate.confirm == 0
                  ? "not asked for; calibrate.options.confirm = 3 simulates three replicates step "
                    "by step in time."
                  : "the fit simulated its replicates step by step in time anyhow.");
  if (compared == 0)
    return {name, Outcome::warn, "Every simulation in time failed: the limit stands unconfirmed."};
  std::string text = fmt::format(
      "{} step by step in time {} from the quasi-static limit by at most {} "
      "in strength and {} in failure strain; single waves of the break, too short for a "
      "testing machine, rise {} higher",
      count(compared, "replicate"), compared == 1 ? "differs" : "differ", percent_text(strength),
      percent_text(strain), percent_text(wave));
  const std::size_t failed = result.confirmations.size() - compared;
  if (failed > 0)
    text += fmt::format("; in time {} more {} no answer to be trusted", failed,
                        failed == 1 ? "has" : "have");
  if (std::max(strength, strain) <= close)
    return {name, failed > 0 ? Outcome::warn : Outcome::pass, text + "."};
  return {name, Outcome::warn, text + ": inertia matters; fit with solver.regime = \"dynamic\"."};
}

Check check_influence(const CalibrationResult& result) {
  constexpr const char* name = "no specimen decides";
  if (result.fitted.empty()) return not_fitted(name);
  std::vector<std::string> alone, strong;
  for (const auto& specimen : result.specimens)
    for (const auto& [parameter, shift] : specimen.influence) {
      // What is of this specimen alone (calibrate.level) is of no other.
      if (parameter.ends_with(fmt::format("[{}]", specimen.id))) continue;
      if (!std::isfinite(shift)) {  // the others do not determine it (F16)
        alone.push_back(specimen.id);
        break;
      }
      if (std::abs(shift) > 2.0)
        strong.push_back(fmt::format("{} ({} by {:.1f})", specimen.id, parameter, shift));
    }
  if (alone.empty() && strong.empty())
    return {name, Outcome::pass,
            "Without any one specimen every parameter stays within two standard errors."};
  std::string text;
  if (!alone.empty())
    text = fmt::format("Without {}{} the parameters are not determined. ",
                       alone.size() > 1 ? "any one of " : "", fmt::join(alone, ", "));
  if (!strong.empty())
    text += fmt::format("Left out, these move a parameter by more than two standard errors: {}. ",
                        fmt::join(strong, ", "));
  return {name, Outcome::warn, text + "Look at these tests, and test more like them."};
}

Check check_correlation(const CalibrationResult& result) {
  constexpr const char* name = "parameters told apart";
  constexpr double high = 0.9;
  if (result.fitted.empty()) return not_fitted(name);
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i < result.correlation.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(result.correlation[i][j]) > high)
        pairs.push_back(fmt::format("{} and {} ({:.2f})", result.fitted[j], result.fitted[i],
                                    result.correlation[i][j]));
  if (pairs.empty())
    return {name, Outcome::pass, "No two parameters are correlated by more than 0.9."};
  // The first sentence of the directions tells their number, the second the direction that is known
  // best.
  std::string text = fmt::format("Correlated by more than 0.9: {}. {}", fmt::join(pairs, ", "),
                                 result.directions.size() > 1 ? result.directions[1] : "");
  if (result.next_tests.empty()) return {name, Outcome::warn, text};
  const auto helps = std::ranges::min_element(result.next_tests, {}, [](const NextTest& test) {
    return *std::ranges::min_element(test.width);
  });
  return {name, Outcome::warn, text + fmt::format(" Most would tell {}.", helps->what)};
}

Check check_intervals(const FitProblem& problem, const CalibrationResult& result) {
  constexpr const char* name = "intervals agree";
  if (result.fitted.empty()) return not_fitted(name);
  std::vector<std::string> differ;
  int compared = 0;
  std::string scale = " in logarithms";  // of all that are compared
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    const CalibratedParameter& parameter = result.parameters[k];
    if (!parameter.identifiable || !problem.study.calibrate.profiles) continue;
    if (const char* const side = open_side(parameter); side != nullptr)
      differ.push_back(fmt::format("{} (open {})", parameter.name, side));
    const ParameterInfo& info = *problem.unknowns[k].info;
    const double part = width(info, parameter.profile_95) / width(info, parameter.slopes_95);
    if (!std::isfinite(part)) continue;
    ++compared;
    if (in_its_scale(info).empty()) scale = "";
    least = std::min(least, part);
    most = std::max(most, part);
    if (part < 0.5 || part > 2.0)
      differ.push_back(fmt::format("{} ({} times as wide{})", parameter.name, two_digits(part),
                                   in_its_scale(info)));
  }
  const std::string wider = wider_bootstraps(problem, result);
  if (compared == 0 && differ.empty())
    return not_checked(name, "no profile was asked for or could be had." + wider);
  if (differ.empty())
    return {name, Outcome::pass,
            fmt::format("Profile likelihood gives intervals {} times as wide{} as the slopes do.{}",
                        times_text(least, most), scale, wider)};
  return {name, Outcome::warn,
          fmt::format("Profile likelihood gives other intervals: {}. Believe the wider one.{}",
                      fmt::join(differ, ", "), wider)};
}

Check check_plain_law(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "better than a plain law";
  if (answer.slopes.failed) return not_fitted(name);
  if (!one_sided_orientations(problem, answer.best).empty())
    return not_checked(
        name, "tests were stopped near their strength, and at most the weaker specimens broke.");
  std::vector<Broken> specimens;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const Target& target = problem.targets[s];
    if (!target.present[strength] || target.censored) continue;  // a bound is no strength
    const auto scene = replicate_scenes(problem, answer.best.point, s, 1).front();
    // A wall at −θ is that at θ in a mirror.
    specimens.push_back({std::abs(problem.study.specimens[s].orientation), scene.joints.scatter,
                         ratio(scene.assembly, scene.joints), target.value[strength],
                         answer.best.predictions[f].mean[strength]});
  }
  const PlainLaw law =
      specimens.empty()
          ? PlainLaw{.criterion = INFINITY}
          : best_plain_law(specimens,
                           parameters_spent(problem, answer.best, chosen_slopes(answer))[strength],
                           problem.study.laws);
  if (!std::isfinite(law.criterion) || !std::isfinite(law.model_criterion))
    return not_checked(
        name,
        fmt::format("{} {} too few to compare the model with a law without fibres.",
                    count(specimens.size(), "strength"), specimens.size() == 1 ? "is" : "are"));
  const double better = law.criterion - law.model_criterion;
  const std::string numbers = fmt::format(
      "AICc of the strengths is {:.1f} for the model and {:.1f} for the best linear "
      "elastic brittle law ({}{})",
      law.model_criterion, law.criterion, law.name,
      problem.study.laws.empty() || law.laws_compared
          ? ""
          : "; the sweep's laws are not compared, as they have none for some orientation");
  if (better < -6.0)
    return {name, Outcome::fail,
            numbers + ": the law without fibres says it better, the model is rejected."};
  if (better < 0.0) return {name, Outcome::warn, numbers + ": these tests do not need the fibres."};
  return {name, Outcome::pass, numbers + "."};
}

std::string weibull_sentence(const CalibrationResult& result, const std::set<double>& one_sided) {
  struct Strengths {
    std::vector<double> measured, simulated;  // over that predicted
  };
  std::map<double, Strengths> by_orientation;  // a mixture has no modulus
  for (const auto& specimen : result.specimens) {
    if (specimen.use != Use::fit || !specimen.measured.broke || !(specimen.strength.mean > 0.0) ||
        one_sided.contains(specimen.orientation))
      continue;
    Strengths& strengths = by_orientation[specimen.orientation];
    strengths.measured.push_back(specimen.measured.strength / specimen.strength.mean);
    for (const auto& replicate : specimen.replicates)
      if (!replicate.failed && replicate.broke)
        strengths.simulated.push_back(replicate.strength / specimen.strength.mean);
  }
  std::string text;
  for (const auto& [orientation, strengths] : by_orientation) {
    if (strengths.measured.size() < 5 || strengths.simulated.size() < 5) continue;
    // weibull() needs values that differ, and replicates of joints without scatter have one value.
    const auto scatter = [](const std::vector<double>& ratios) {
      const auto [least, most] = std::ranges::minmax(ratios);
      return most - least > 1e-9;
    };
    if (!scatter(strengths.measured)) continue;
    const Weibull tests = weibull(strengths.measured);
    text += fmt::format(
        " The scatter of the strengths measured at {:.4g} deg about those predicted is that of a "
        "Weibull modulus of {:.3g} (95 % interval {:.3g} to {:.3g}), the replicates {}.",
        orientation / degree, tests.unbiased, tests.interval_95[0], tests.interval_95[1],
        scatter(strengths.simulated)
            ? fmt::format("have one of {:.3g}", weibull(strengths.simulated).unbiased)
            : "do not scatter");
  }
  return text;
}

}  // namespace havers::calib
