// Words and counts of a result. Tables of words are in the order of their enumerators.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "calib/count.hpp"
#include "calib/fit/calibration.hpp"

namespace havers::calib {

std::string explain(CalibrationStatus status) {
  constexpr std::array sentences{
      "the searches stopped at a minimum",
      "the budget of simulations ended before the searches did; the best point so far is given",
      "where the searches ended, the replicates asked for give some specimen no usable answer",
      "the specimens inform none of the parameters",
      "stopped by the user; the next run in the same folder goes on from here"};
  return sentences.at(static_cast<std::size_t>(status));
}

long SpecimenResult::usable() const {
  return std::ranges::count_if(replicates, [](const auto& one) { return !one.failed; });
}

long SpecimenResult::unbroken() const {
  return std::ranges::count_if(replicates,
                               [](const auto& one) { return !one.failed && !one.broke; });
}

std::string to_string(Outcome outcome) {
  constexpr std::array words{"pass", "warn", "fail"};
  return words.at(static_cast<std::size_t>(outcome));
}

std::vector<std::string> checks_with(const CalibrationResult& result, Outcome outcome) {
  std::vector<std::string> names;
  for (const Check& check : result.verdict)
    if (check.outcome == outcome) names.push_back(check.check);
  return names;
}

bool CalibrationResult::trusted() const {
  return status == CalibrationStatus::converged && checks_with(*this, Outcome::fail).empty();
}

std::string why_not_trusted(const CalibrationResult& result) {
  if (result.status != CalibrationStatus::converged) return explain(result.status);
  const auto failed = checks_with(result, Outcome::fail);
  return fmt::format("{} of {} failed ({})", failed.size(), count(result.verdict.size(), "check"),
                     fmt::join(failed, ", "));
}

}  // namespace havers::calib
