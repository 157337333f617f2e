// What of the answer is the simulations' own chance.
#pragma once

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// The answer looked at with as many fresh seeds, and how much the replicates' chance is of the
/// errors (F17). Precondition: !answer.slopes.failed.
Randomness randomness_of(SimulationBatch& batch, const FitProblem& problem, const Answer& answer);

/// Replicates with which the chance of their mean is a small part of the variance of every residual
/// that tells something.
int replicates_needed(const FitProblem& problem, const Weights& weights, const Evaluation& at);

}  // namespace havers::calib
