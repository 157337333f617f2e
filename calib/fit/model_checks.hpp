// Whether the model may be believed: the checks of the verdict that compare it with the tests.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// "2.6", "280", "0" for rounding: a size in plain digits, the first two at least.
std::string two_digits(double value);

/// "2.6 %", "280 %": a part in plain digits.
std::string percent_text(double part);

/// "p = 0.03", "p < 1e-6": the probability of a test; "too few to tell" without one.
std::string chance_text(std::optional<double> p);

/// " in logarithms", or nothing: behind a ratio of widths, which is one in the scale of the search.
std::string in_its_scale(const ParameterInfo& info);

/// Whether two tests have the same record, number for number: of no two specimens does noise give
/// that.
bool same_record(const MeasuredTest& one, const MeasuredTest& other);

/// Whether a parameter of that name is, for any of the specimens.
bool is_fitted(const FitProblem& problem, const Answer& answer, std::string_view parameter);

/// What no unknown that is free to move can follow of the answer's residuals, and what is spent of
/// each on those that can (F9).
struct Unfollowed {
  Eigen::VectorXd residuals, spent;
};
/// @param factor  what each residual is to be weighed by, beside its weight in the answer
Unfollowed unfollowed(const FitProblem& problem, const Answer& answer,
                      const Eigen::VectorXd& factor);

/// Tests less likely than this reject what they test. [-]
inline constexpr double significance = 0.01;

/// The measured curves are as straight up to the break as the model's (F13).
Check check_brittle(const FitProblem& problem, const Answer& answer);

/// The residuals do not differ between orientations (F14).
Check check_orientations(const FitProblem& problem, const Answer& answer);

/// How much the specimens differ beyond noise and the model's own randomness (F9).
Check check_specimen_spread(const FitProblem& problem, const Answer& answer);

/// Specimens kept for validation lie where the fitted ones say (F24).
/// @param left_out  parameters asked for by name that were not fitted
Check check_validation(const CalibrationResult& result, const std::vector<std::string>& left_out);

/// The simulations break, so that there is a strength to compare.
Check check_censored(const CalibrationResult& result);

}  // namespace havers::calib
