#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "calib/count.hpp"
#include "calib/fit/calibration.hpp"

namespace havers::calib {

std::string explain(CalibrationStatus status) {
  constexpr std::array sentences{
      "the searches stopped at a minimum",
      "the budget of simulations ended before the searches did; the best point so far is given",
      "at no point did all replicates asked for give every specimen a usable answer",
      "the specimens inform none of the parameters",
      "stopped by the user; the next run in the same folder goes on from here"};
  return sentences.at(static_cast<std::size_t>(status));
}

std::string to_string(Outcome outcome) {
  constexpr std::array words{"pass", "warn", "fail"};
  return words.at(static_cast<std::size_t>(outcome));
}

bool CalibrationResult::trusted() const {
  const auto failed = [](const Check& check) { return check.outcome == Outcome::fail; };
  return status == CalibrationStatus::converged && std::ranges::none_of(verdict, failed);
}

std::string why_not_trusted(const CalibrationResult& result) {
  if (result.status != CalibrationStatus::converged) return explain(result.status);
  std::vector<std::string_view> failed;
  for (const Check& check : result.verdict)
    if (check.outcome == Outcome::fail) failed.push_back(check.check);
  return fmt::format("{} of {} failed ({})", failed.size(), count(result.verdict.size(), "check"),
                     fmt::join(failed, ", "));
}

}  // namespace havers::calib
