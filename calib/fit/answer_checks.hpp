// The checks of the verdict that look at the answer itself: would it be the same with other seeds,
// other specimens, another law?
#pragma once

#include <set>
#include <string>

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// Fresh seeds give the same answer, and the simulations' chance is a small part of the errors
/// (F17).
Check check_randomness(const CalibrationResult& result);

/// Quasi-static answers hold in time; asked for by calibrate.options.confirm.
Check check_confirmation(const FitProblem& problem, const CalibrationResult& result);

/// No single specimen decides a parameter (F16).
Check check_influence(const CalibrationResult& result);

/// Parameters are told apart: no correlation above 0.9 in size.
Check check_correlation(const CalibrationResult& result);

/// Wald's and the profile's intervals are about as wide, and end on the same sides; says where the
/// bootstrap's are wider.
Check check_intervals(const FitProblem& problem, const CalibrationResult& result);

/// The model describes the strengths better than laws without fibres (F19).
Check check_plain_law(const FitProblem& problem, const Answer& answer);

/// What spread the strengths of each orientation show, beside that of the replicates, as Weibull's
/// moduli; nothing where fewer than five broke.
/// @param one_sided  orientations that say nothing of it, from `one_sided_orientations`
std::string weibull_sentence(const CalibrationResult& result, const std::set<double>& one_sided);

}  // namespace havers::calib
