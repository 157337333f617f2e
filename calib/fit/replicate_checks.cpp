// The checks by the simulations at the answer: of specimens kept for validation, and whether all
// break.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "calib/count.hpp"
#include "calib/fit/model_checks.hpp"

namespace havers::calib {
namespace {

// Standard deviations that a specimen kept for validation may be off. [-]
constexpr double largest_off = 3.0;

// Strengths of replicates, and with them failure strains, may have a long tail, and one of them be
// as far from their mean.
bool is_among_replicates(const SpecimenResult& specimen, double ReplicateResult::*number,
                         double measured) {
  const auto some = [&](auto compare) {
    return std::ranges::any_of(specimen.replicates, [&](const ReplicateResult& one) {
      return !one.failed && compare(one.*number, measured);
    });
  };
  return some(std::less_equal{}) && some(std::greater_equal{});
}

// (F24) What is left out may explain it, and excuses nothing: the model that is handed over has the
// value with which it does not predict.
std::string prediction_off(const std::vector<std::string>& off,
                           const std::vector<std::string>& left_out) {
  const auto why = left_out.empty()
                       ? std::string("The parameters do not carry over to them.")
                       : fmt::format(
                             "The model as it is fitted does not predict them, probably "
                             "because what is left out ({}) has another value than it is "
                             "given; fitted too (use = \"fit\"), they may tell it.",
                             fmt::join(left_out, ", "));
  return fmt::format("Held-out specimens are off by more than three standard deviations: {}. {}",
                     fmt::join(off, ", "), why);
}

// Whether the fit has seen its test, as another specimen's.
bool was_seen(const CalibrationResult& result, const SpecimenResult& specimen) {
  return std::ranges::any_of(result.specimens, [&](const SpecimenResult& other) {
    return other.use == Use::fit && same_record(other.measured, specimen.measured);
  });
}

}  // namespace

Check check_validation(const CalibrationResult& result, const std::vector<std::string>& left_out) {
  constexpr const char* name = "held-out specimens";
  int held_out = 0;
  bool seen = false;
  std::vector<std::string> off, unknown;
  for (const auto& specimen : result.specimens) {
    if (specimen.use != Use::validate) continue;
    if (was_seen(result, specimen)) {
      seen = true;
      continue;
    }
    ++held_out;
    double worst = std::nan("");
    // Modulus, strength, failure strain; fmax passes over those that are not compared, which are
    // NaN.
    std::array<double, 3> residual = specimen.residual;
    const auto excuse = [&](double& one, double ReplicateResult::*number, double measured) {
      if (is_among_replicates(specimen, number, measured))
        one = std::clamp(one, -largest_off, largest_off);
    };
    excuse(residual[1], &ReplicateResult::strength, specimen.measured.strength);
    excuse(residual[2], &ReplicateResult::failure_strain, specimen.measured.failure_strain);
    for (const double one : residual) worst = std::fmax(worst, std::abs(one));
    // A strength that simulations do not reach is compared with nothing.
    const bool open = specimen.measured.broke && specimen.mostly_unbroken();
    if (std::isnan(worst) || open) unknown.push_back(specimen.id);
    if (worst > largest_off) off.push_back(fmt::format("{} ({:.1f})", specimen.id, worst));
  }
  if (held_out == 0)
    return not_checked(name, seen ? "the fit has seen every test that was kept for validation."
                                  : "none was kept for validation (use = \"validate\").");
  if (off.empty() && unknown.empty())
    return {name, Outcome::pass,
            fmt::format("{} {} within three standard deviations of the prediction.",
                        count(held_out, "held-out specimen"), held_out == 1 ? "lies" : "lie")};
  std::vector<std::string> sentences;
  if (!off.empty()) sentences.push_back(prediction_off(off, left_out));
  if (!unknown.empty())
    sentences.push_back(
        fmt::format("Nothing can be compared of held-out specimens whose simulations failed or did "
                    "not break, or whose tests tell too little: {}.",
                    fmt::join(unknown, ", ")));
  return {name, Outcome::fail, fmt::format("{}", fmt::join(sentences, " "))};
}

Check check_censored(const CalibrationResult& result) {
  constexpr const char* name = "simulations break";
  const auto censored = std::ranges::count_if(result.specimens, &SpecimenResult::mostly_unbroken);
  if (censored > 0)
    return {name, Outcome::fail,
            fmt::format("{} of {} {} not break in the simulations: raise model.loading.max_strain.",
                        censored, count(result.specimens.size(), "specimen"),
                        censored == 1 ? "does" : "do")};
  long unbroken = 0, all = 0;
  for (const SpecimenResult& specimen : result.specimens) {
    unbroken += specimen.unbroken();
    all += specimen.usable();
  }
  if (unbroken == 0) return {name, Outcome::pass, "Every specimen's simulations break."};
  return {name, Outcome::warn,
          fmt::format("{} of {} simulations at the answer reach model.loading.max_strain before "
                      "they break, and count with their largest stress up to there: raise it.",
                      unbroken, all)};
}

}  // namespace havers::calib
