// What of the answer is the simulations' own chance.
#pragma once

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// The answer looked at with as many fresh seeds, and how much the replicates' chance is of the
/// errors (F17). Precondition: !answer.slopes.failed.
Randomness randomness_of(SimulationBatch& batch, const FitProblem& problem, const Answer& answer);

/// Replicates with which the chance of their mean is a small part of every residual's variance.
int replicates_needed(const FitProblem& problem, const Weights& weights);

/// As many replicates of the fitted specimens simulated step by step in time, at the fastest rate
/// that still counts as quasi-static, against the same seeds in the quasi-static limit.
std::vector<Confirmation> confirm_in_time(SimulationBatch& batch, const FitProblem& problem,
                                          const Answer& answer);

}  // namespace havers::calib
