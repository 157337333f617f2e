#include <algorithm>

#include "calib/fit/calibration.hpp"

namespace havers::calib {

std::string to_string(CalibrationStatus status) {
  switch (status) {
    case CalibrationStatus::converged:
      return "converged";
    case CalibrationStatus::budget_spent:
      return "budget_spent";
    case CalibrationStatus::all_failed:
      return "all_failed";
    case CalibrationStatus::nothing_to_fit:
      return "nothing_to_fit";
    case CalibrationStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

std::string explain(CalibrationStatus status) {
  switch (status) {
    case CalibrationStatus::converged:
      return "the searches stopped at a minimum";
    case CalibrationStatus::budget_spent:
      return "the budget of simulations ended before the searches did; the best point so far is "
             "given";
    case CalibrationStatus::all_failed:
      return "nowhere did the simulations of every specimen give a usable answer";
    case CalibrationStatus::nothing_to_fit:
      return "the specimens inform none of the parameters";
    case CalibrationStatus::cancelled:
      return "stopped by the user; the next run in the same folder goes on from here";
  }
  return "unknown";
}

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::pass:
      return "pass";
    case Outcome::warn:
      return "warn";
    case Outcome::fail:
      return "fail";
  }
  return "unknown";
}

bool CalibrationResult::trusted() const {
  const auto failed = [](const Check& check) { return check.outcome == Outcome::fail; };
  return status == CalibrationStatus::converged && std::ranges::none_of(verdict, failed);
}

}  // namespace havers::calib
