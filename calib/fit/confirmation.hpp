// The answer in the quasi-static limit against simulations step by step in time.
#pragma once

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// As many replicates as the study asks for, spread over the fitted specimens, step by step in time
/// at the fastest rate that still counts as quasi-static, against the same seeds in the limit
/// (F21). Specimens that the fit itself simulated in time are not among them. Precondition: a
/// specimen is fitted.
std::vector<Confirmation> confirm_in_time(SimulationBatch& batch, const FitProblem& problem,
                                          const Answer& answer);

}  // namespace havers::calib
