// Slopes of one specimen that the fit did not see.
#pragma once

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// Slopes of a specimen's landmarks at the answer, a row each, along the active unknowns, which are
/// in the scale of their search; empty where simulations failed.
/// @param as  the specimen of the study whose unknowns it has
Eigen::MatrixXd specimen_slopes(SimulationBatch& batch, const FitProblem& problem,
                                const Answer& answer, const Specimen& specimen, std::size_t as);

}  // namespace havers::calib
