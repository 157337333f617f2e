// Whether the parameters are what they are called, and known: inside their bounds, informed by the
// specimens, and of bone alone.
#pragma once

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// No fitted parameter lies at a bound.
Check check_bounds(const FitProblem& problem, const Answer& answer,
                   const CalibrationResult& result);

/// The specimens inform every parameter asked for (F10), and no interval has most of its bounds.
Check check_identifiable(const FitProblem& problem, const Answer& answer,
                         const CalibrationResult& result);

/// No specimen has the record of another, as a copied file gives it.
Check check_records(const FitProblem& problem);

/// Some test broke; else strengths are bounds, and so are the thresholds (F25).
Check check_broke(const FitProblem& problem, const Answer& answer);

/// Curves are, above the windows of their moduli, no steeper than the modulus's interval allows
/// (F28).
Check check_toe(const FitProblem& problem, const Answer& answer);

/// No modulus that is fitted has the machine's compliance in it (X2).
Check check_strain(const FitProblem& problem, const Answer& answer);

}  // namespace havers::calib
