// What the searches came to, and the parts of the result that are made of it.
#pragma once

#include <vector>

#include "calib/fit/calibration.hpp"
#include "calib/fit/fit_problem.hpp"
#include "calib/fit/identifiability.hpp"
#include "calib/fit/uncertainty.hpp"

namespace havers::calib {

/// Slopes of the residuals along what is fitted and, beside it, along what was asked for and left
/// out (F9).
struct AskedSlopes {
  Eigen::MatrixXd jacobian;
  Active unknowns;  ///< Of each column.
};

/// The best point, with everything known about it.
struct Answer {
  CalibrationStatus status = CalibrationStatus::all_failed;
  /// The trail's best by `weights`; failed where no point has an answer.
  Evaluation best;
  Weights weights;
  Active active;                      ///< Unknowns that were fitted.
  std::vector<LeftUnknown> left;      ///< Unknowns that were not.
  std::vector<Evaluation> ends;       ///< Where the refined starts came to, best first.
  std::vector<StageLog> stages;       ///< In the order of the search.
  std::vector<double> starts;         ///< Costs of all starts, lowest first.
  int replicates = 0;                 ///< Of each specimen at the answer.
  bool agrees = true;                 ///< The weights, with what the searches came to by them.
  Differences slopes;                 ///< At the best point; failed where it could not be had.
  AskedSlopes asked;                  ///< The same Jacobian, and what was left out beside it.
  Uncertainty uncertainty;            ///< Empty when `slopes` failed.
  std::vector<Evaluation> elsewhere;  ///< Along the unknowns asked for that were left out (F22).
  std::vector<Profile> profiles;  ///< In the order of `active` (F15); empty where not asked for.
};

/// Values of all unknowns in their order, with errors and intervals by the slopes; add_hindsight
/// sets the intervals by profile and bootstrap.
std::vector<CalibratedParameter> parameters_of(const FitProblem& problem, const Answer& answer);

/// Every specimen simulated at the answer, those kept for validation too, in the study's order.
std::vector<SpecimenResult> specimens_of(const FitProblem& problem, SimulationBatch& batch,
                                         const Answer& answer);

/// ½ Σ residual² over the terms of the fitted specimens, which have the weights of the answer;
/// `otherwise` where there are no terms.
double cost_of(const std::vector<SpecimenResult>& specimens, double otherwise);

/// Correlations of the fitted parameters, what is determined in words, intervals by other means,
/// and what a further test would tell: all that follows from the slopes at the answer; where these
/// failed, only the costs of the starts and of their ends. Precondition: `result` has its
/// parameters and specimens.
void add_hindsight(const FitProblem& problem, SimulationBatch& batch, const Answer& answer,
                   CalibrationResult& result);

/// What the calibration did without.
std::vector<sim::LeftOut> left_out_of(const FitProblem& problem, const SimulationBatch& batch,
                                      const Answer& answer);

/// What passes for want of anything to check; `why` ends with its full stop.
Check not_checked(const std::string& check, const std::string& why);

/// One sentence per check, with its numbers and what to do. Precondition: all else of `result` is
/// there.
std::vector<Check> verdict_of(const FitProblem& problem, const Answer& answer,
                              const CalibrationResult& result);

}  // namespace havers::calib
