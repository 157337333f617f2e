#include "calib/fit/parameter_checks.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calib/count.hpp"
#include "calib/experiment/robust_line.hpp"
#include "calib/fit/model_checks.hpp"
#include "calib/fit/statistics.hpp"

namespace havers::calib {
namespace {

// What an unknown that was left out is in the answer, by its value there.
std::string where_left(const Unknown& unknown, double position) {
  const char* const ground = at_bound(unknown, position) ? ", a bound"
                             : position != unknown.start ? ""
                             : unknown.info->of_porosity ? ", the value of [porosity]"
                                                         : ", the value of [model]";
  return fmt::format("{:.4g}{}", value_in_unit(unknown, position), ground);
}

// Half a sentence on the landmark that would tell an unknown and is no term of the study; nothing
// where there is none.
std::string missing_term(const FitProblem& problem, const LeftUnknown& one) {
  const std::string_view parameter = problem.unknown(one.unknown).info->name;
  const bool elastic = parameter == "young_GPa" || parameter == "modulus_exponent";
  const auto term = name_of(elastic ? modulus : strength);
  const auto& terms = problem.study.calibrate.terms;
  return std::ranges::find(terms, term) != terms.end() ? "" : fmt::format("\"{}\"", term);
}

// Another angle tells no scatter where angles differ already: with each, d goes as σ₁. Nor does it
// tell what breaks a specimen, where none broke, nor what no term shows.
std::string what_may_tell(const FitProblem& problem, const std::vector<LeftUnknown>& left) {
  const auto broke = [&](std::size_t s) { return !problem.targets[s].censored; };
  if (std::ranges::none_of(problem.fitted, broke)) return "tests up to the break may tell it.";
  for (const LeftUnknown& one : left)
    if (const std::string term = missing_term(problem, one); !term.empty())
      return fmt::format("{} among calibrate.options.terms may tell it.", term);
  std::set<double> orientations;
  for (const std::size_t s : problem.fitted)
    orientations.insert(problem.study.specimens[s].orientation);
  const auto is_scatter = [&](const LeftUnknown& one) {
    return orientations.size() > 1 && problem.unknown(one.unknown).info->name == "scatter";
  };
  std::string text;
  if (!std::ranges::all_of(left, is_scatter))
    text = "specimens at another orientation may tell it.";
  if (std::ranges::any_of(left, is_scatter))
    text += text.empty() ? "sections (porosity) may tell it."
                         : " Sections (porosity) may tell scatter.";
  return text;
}

/// Intervals of informed unknowns that cover much of their bounds.
struct WideIntervals {
  std::string text;
  bool nothing_told = false;
};

// What few degrees of freedom, or unknowns that are left out, leave of one that is informed (F10).
// Bounds alone, without a test, give an interval of 95 % of their range.
WideIntervals wide_intervals(const FitProblem& problem, const CalibrationResult& result) {
  constexpr double warned = 0.5, as_without_tests = 0.9;  // parts of the bounds' range
  WideIntervals wide;
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    const CalibratedParameter& parameter = result.parameters[k];
    if (!parameter.identifiable) continue;
    const Unknown& unknown = problem.unknowns[k];
    const auto position = [&](double value) {
      return std::clamp(to_search(*unknown.info, value), unknown.lower, unknown.upper);
    };
    const auto [low, high] = parameter.interval_95;
    const double part = (position(high) - position(low)) / unknown.range();
    if (part <= warned) continue;
    const bool nothing = part > as_without_tests;
    wide.nothing_told = wide.nothing_told || nothing;
    wide.text += fmt::format(" The 95 % interval of {} covers {} of the range of its bounds{}, {}.",
                             parameter.name, percent_text(part), in_its_scale(*unknown.info),
                             nothing ? "hardly less than without any test: its value is not known"
                                     : "which tell much of it");
  }
  return wide;
}

// Slope of a curve over its modulus, less 1: the upper half of what lies between the beginning of
// the modulus's window and nine tenths of the strength. No value where too few rows tell it.
std::optional<double> steepening(const MeasuredTest& test) {
  constexpr double nearly_failed = 0.9;
  constexpr std::size_t rows_that_tell = 5;
  const double low = test.modulus * test.window_low, high = nearly_failed * test.strength;
  const auto peak = std::ranges::max_element(test.stress);
  std::vector<double> strain, stress;
  for (auto row = test.stress.begin(); row != peak; ++row) {
    if (*row < 0.5 * (low + high) || *row > high) continue;
    strain.push_back(test.strain[static_cast<std::size_t>(row - test.stress.begin())]);
    stress.push_back(*row);
  }
  if (stress.size() < rows_that_tell || !(test.modulus > 0.0)) return std::nullopt;
  return fit_plain_line(strain, stress).slope / test.modulus - 1.0;
}

/// That of the tests that share a modulus.
struct Toes {
  std::string parameter;
  Statistics part;        // [-]
  double known_to = 0.0;  // half width of the modulus's interval [-]

  // Three standard errors; more where few tests tell these.
  [[nodiscard]] bool plain() const {
    const double certain =
        std::max(3.0, gsl_cdf_tdist_Qinv(significance, static_cast<double>(part.n - 1)));
    return part.mean >= certain * part.standard_error() && part.mean >= known_to;
  }
};

Toes toes_of(const FitProblem& problem, const Unknown& modulus_of, double known_to) {
  std::vector<double> parts;
  for (const std::size_t s : problem.fitted) {
    if (std::ranges::find(modulus_of.specimens, s) == modulus_of.specimens.end()) continue;
    if (const auto part = steepening(problem.study.specimens[s].test)) parts.push_back(*part);
  }
  return {modulus_of.label, statistics_of(parts), known_to};
}

}  // namespace

// What was left out and kept where the search ran into a bound is no value either.
Check check_bounds(const FitProblem& problem, const Answer& answer,
                   const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const auto& parameter : result.parameters)
    if (parameter.at_bound)
      names.push_back(fmt::format("{} = {:.4g} of [{:.4g}, {:.4g}]", parameter.name,
                                  parameter.value, parameter.bounds[0], parameter.bounds[1]));
  std::vector<std::string> kept;
  for (const LeftUnknown& one : answer.left)
    if (const Unknown& unknown = problem.unknown(one.unknown);
        one.kept_where_found && at_bound(unknown, answer.best.point[one.unknown]))
      kept.push_back(unknown.label);
  if (names.empty() && !kept.empty())
    return {"inside bounds", Outcome::warn,
            fmt::format(
                "No fitted parameter lies at a bound, but {}, left out, was found at one: "
                "the values of the others hold beside that one only, their intervals beside each "
                "that is likely.",
                fmt::join(kept, ", "))};
  if (names.empty())
    return {"inside bounds", Outcome::pass, "No fitted parameter lies at a bound."};
  return {"inside bounds", Outcome::fail,
          fmt::format("At a bound: {}. Widen calibrate.bounds if the value beyond makes sense; if "
                      "not, the model does not describe these specimens.",
                      fmt::join(names, ", "))};
}

Check check_identifiable(const FitProblem& problem, const Answer& answer,
                         const CalibrationResult& result) {
  if (answer.left.empty() && answer.slopes.failed)
    return not_checked("identifiable", "there is no interval.");
  const auto [wide, nothing_told] = wide_intervals(problem, result);
  const Outcome doubt = nothing_told ? Outcome::fail : Outcome::warn;
  if (answer.left.empty() && !wide.empty()) return {"identifiable", doubt, wide.substr(1)};
  if (answer.left.empty())
    return {"identifiable", Outcome::pass, "The specimens inform every parameter asked for."};
  const bool asked = !problem.study.calibrate.automatic, none_fitted = answer.active.empty();
  std::string text;
  bool conditional = false;
  for (const LeftUnknown& one : answer.left) {
    const Unknown& unknown = problem.unknown(one.unknown);
    text += fmt::format("{} is left out: {}. It stays at {}. ", unknown.label, one.reason(),
                        where_left(unknown, answer.best.point[one.unknown]));
    // What was asked for widens the others' intervals (F22); what "auto" leaves out does not.
    if (asked || std::ranges::count(answer.active, one.partner) == 0) continue;
    conditional = true;
    text += fmt::format("The interval of {} holds for that value only. ",
                        problem.unknown(one.partner).label);
  }
  text += "What is left out has no interval; " + what_may_tell(problem, answer.left);
  if (asked && !none_fitted)
    text += fmt::format(
        " The intervals of the others hold wherever the specimens allow {} to be.",
        answer.left.size() == 1 ? "it" : "each of what is left out, by itself with the rest held,");
  const bool doubted = asked || none_fitted || conditional || !wide.empty();
  return {"identifiable", doubted ? doubt : Outcome::pass, text + wide};
}

Check check_records(const FitProblem& problem) {
  constexpr const char* name = "every test once";
  std::vector<std::string> twice, seen;
  const std::vector<Specimen>& all = problem.study.specimens;
  for (auto one = all.begin(); one != all.end(); ++one)
    for (auto other = all.begin(); other != one; ++other)
      if (same_record(one->test, other->test))
        (one->use == other->use ? twice : seen)
            .push_back(fmt::format("{} and {}", other->id, one->id));
  if (twice.empty() && seen.empty())
    return {name, Outcome::pass, "No two specimens have the same record."};
  const auto alike = [](const std::vector<std::string>& pairs, const char* so) {
    return pairs.empty() ? ""
                         : fmt::format("The records of {} are the same, number for number: {} ",
                                       fmt::join(pairs, ", "), so);
  };
  return {name, Outcome::warn,
          alike(twice, "the test counts twice, and intervals are too narrow.") +
              alike(seen,
                    "a fit that has seen a test is not tested by it, and \"held-out specimens\" "
                    "leaves it out.") +
              "Give each specimen its own file, or leave one out."};
}

// (F25) A strength of the answer below what a test bore is contradicted by it.
Check check_broke(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "tests broke";
  constexpr double certain = 3.0;  // standard deviations
  const std::size_t all = problem.fitted.size();
  const auto broken = std::ranges::count_if(
      problem.fitted, [&](std::size_t s) { return !problem.targets[s].censored; });
  if (broken > 0)
    return {name, Outcome::pass, fmt::format("{} of {} broke.", broken, count(all, "fitted test"))};
  std::vector<std::string> stronger;
  for (std::size_t f = 0; f < all && answer.best.residuals.size() > 0; ++f)
    if (answer.best.residuals[first_row(f) + strength] < -certain)
      stronger.push_back(problem.study.specimens[problem.fitted[f]].id);
  const std::string what =
      "Every fitted test was stopped before it broke: the strengths are lower bounds, and bound "
      "the joints' thresholds from below only. ";
  if (stronger.empty())
    return {name, Outcome::warn,
            what + "Those of the answer are among many that may be; test up to the break."};
  return {
      name, Outcome::fail,
      what + fmt::format("Those of the answer are too low: {} bore more. Fit head_tail_MPa too, "
                         "and test up to the break.",
                         fmt::join(stronger, ", "))};
}

// (F28) What no single test shows may be plain in all: each window is straight within its noise.
Check check_toe(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "modulus clear of toes";
  std::vector<Toes> groups;
  for (Eigen::Index i = 0; i < answer.uncertainty.half_width.size(); ++i)
    if (const Unknown& unknown = problem.unknown(answer.active[static_cast<std::size_t>(i)]);
        unknown.info->name == "young_GPa")
      // E is searched in its logarithm: half widths are parts of E, as the steepening is.
      groups.push_back(toes_of(problem, unknown, answer.uncertainty.half_width[i]));
  if (groups.empty()) return not_checked(name, "young_GPa has no interval.");
  std::erase_if(groups, [](const Toes& one) { return one.part.n < 3; });
  if (groups.empty()) return not_checked(name, "it takes three tests with rows enough.");
  const auto plain = std::ranges::find_if(groups, &Toes::plain);
  if (plain == groups.end())
    return {name, Outcome::pass,
            "Above the windows of the moduli curves are no steeper than the interval of young_GPa "
            "allows."};
  return {
      name, Outcome::warn,
      fmt::format("Above the windows of the moduli curves are steeper by {} ± {} on average, as "
                  "after toes that no single test shows: {} is too low by about as much, "
                  "and its interval, ± {}, does not contain that. Raise reduction.window_low "
                  "and window_high.",
                  percent_text(plain->part.mean), percent_text(plain->part.standard_error()),
                  plain->parameter, percent_text(plain->known_to))};
}

Check check_strain(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "strain of bone alone";
  if (!is_fitted(problem, answer, "young_GPa"))
    return not_checked(name, "young_GPa is not fitted.");
  std::vector<std::string> with_machine;
  for (const std::size_t s : problem.fitted)
    if (problem.targets[s].present[modulus] && problem.study.specimens[s].test.machine_in_strain)
      with_machine.push_back(problem.study.specimens[s].id);
  if (with_machine.empty())
    return {name, Outcome::pass, "No fitted modulus has the machine's compliance in it."};
  return {name, Outcome::warn,
          fmt::format("The strain of {} is the crosshead's, with the machine in it: young_GPa is "
                      "that of bone and machine together, too low by it, and its interval does not "
                      "contain that. Give machine_compliance_mm_per_kN, or the strain of a gauge.",
                      fmt::join(with_machine, ", "))};
}

}  // namespace havers::calib
