#include "cli/fit_summary.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "calib/count.hpp"
#include "cli/command.hpp"

namespace havers::cli {
namespace {

// Value and interval are in the unit that the parameter's name contains, as in "flank_MPa".
void print_parameter(const calib::CalibratedParameter& parameter) {
  if (!parameter.identifiable) {
    fmt::print("  {:<22}{:>10.5g}  not determined: {}\n", parameter.name, parameter.value,
               parameter.left_out_because);
    return;
  }
  fmt::print("  {:<22}{:>10.5g}  95 % interval {:.5g} to {:.5g}{}\n", parameter.name,
             parameter.value, parameter.interval_95[0], parameter.interval_95[1],
             parameter.at_bound ? "  AT ITS BOUND" : "");
}

// A row of the table; the measured modulus and strength stand before the simulated ones.
void print_specimen(const calib::SpecimenResult& specimen) {
  fmt::print("  {:<12}{:>9}{:>11}{:>12}{:>12}{:>11}{:>11}{}\n", specimen.id,
             cell(1e-9 * specimen.measured.modulus, 2), cell(1e-9 * specimen.modulus.mean, 2),
             cell(1e-6 * specimen.measured.strength, 2), cell(1e-6 * specimen.strength.mean, 2),
             cell(specimen.porosity, 3), cell(specimen.scatter, 3),
             specimen.measured.broke ? "" : "  not broken");
}

// Whether the fit can be trusted, and what speaks against that.
std::string headline(const calib::CalibrationResult& result) {
  if (!result.trusted()) return "NOT to be trusted: " + why_not_trusted(result);
  const auto warned = checks_with(result, calib::Outcome::warn);
  if (warned.empty()) return "to be trusted: " + calib::explain(result.status);
  return fmt::format("to be trusted, with {}: {}", calib::count(warned.size(), "reservation"),
                     fmt::join(warned, ", "));
}

}  // namespace

void print_fit_summary(const calib::CalibrationResult& result, double wall_seconds, bool verbose) {
  fmt::print("{}\n", headline(result));
  for (const calib::Check& check : result.verdict)
    fmt::print("  {:<5}{}: {}\n", check.done ? calib::to_string(check.outcome) : "-", check.check,
               check.text);
  fmt::print("parameters\n");
  for (const calib::CalibratedParameter& parameter : result.parameters) print_parameter(parameter);
  fmt::print("specimens     E [GPa]  simulated  sigma [MPa]  simulated   porosity    scatter\n");
  for (const calib::SpecimenResult& specimen : result.specimens) print_specimen(specimen);
  fmt::print("{:.3g} s {}: {} simulations, {} of them new, {} failed\n", wall_seconds,
             std::isfinite(result.cost) ? fmt::format("for a cost of {:.4g}", result.cost)
                                        : "without an answer",
             result.evaluations, result.simulated, result.failed_simulations);
  if (!verbose) return;
  for (const sim::LeftOut& left_out : result.left_out)
    fmt::print("left out: {}: {}\n", left_out.what, left_out.why);
}

}  // namespace havers::cli
