#include "calib/fit/parameter_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

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

}  // namespace

Check check_bounds(const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const auto& parameter : result.parameters)
    if (parameter.at_bound)
      names.push_back(fmt::format("{} = {:.4g} of [{:.4g}, {:.4g}]", parameter.name,
                                  parameter.value, parameter.bounds[0], parameter.bounds[1]));
  if (names.empty())
    return {"inside bounds", Outcome::pass, "No fitted parameter lies at a bound."};
  return {"inside bounds", Outcome::fail,
          fmt::format("At a bound: {}. Widen calibrate.bounds if the value beyond makes sense; if "
                      "not, the model does not describe these specimens.",
                      fmt::join(names, ", "))};
}

Check check_identifiable(const FitProblem& problem, const Answer& answer) {
  if (answer.left.empty())
    return {"identifiable", Outcome::pass, "The specimens inform every parameter asked for."};
  std::string text;
  for (const auto& [index, because] : answer.left) {
    const Unknown& unknown = problem.unknowns[static_cast<std::size_t>(index)];
    text += fmt::format("{} is left out: {}. It stays at {}. ", unknown.label, because,
                        where_left(unknown, answer.best.point[index]));
  }
  const bool asked = !problem.study.calibrate.automatic, none_fitted = answer.active.empty();
  return {"identifiable", asked || none_fitted ? Outcome::warn : Outcome::pass,
          text + "What is left out has no interval; specimens at another orientation may tell it." +
              (asked && !none_fitted
                   ? " The intervals of the others hold wherever the specimens allow it to be."
                   : "")};
}

Check check_strain(const FitProblem& problem, const Answer& answer) {
  constexpr const char* name = "strain of bone alone";
  const auto is_modulus = [&](Eigen::Index k) {
    return problem.unknowns[static_cast<std::size_t>(k)].info->name == "young_GPa";
  };
  if (std::ranges::none_of(answer.active, is_modulus))
    return {name, Outcome::pass, "Not checked: young_GPa is not fitted.", false};
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
