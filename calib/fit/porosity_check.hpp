// Whether porosity explains what the model leaves of the moduli and strengths.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// What one landmark's residuals may follow, a row for each specimen.
struct PorositySample {
  Eigen::VectorXd difference;  ///< Simulated − measured, of logarithms. [-]
  Eigen::VectorXd variance;    ///< Of it, without what specimens differ by. [-]
  Eigen::VectorXd porosity;    ///< [-]
  Eigen::MatrixXd slopes;      ///< ∂ difference / ∂ each fitted parameter.
};

/// A straight line through the differences over porosity.
struct PorosityTrend {
  double slope = 0.0;   ///< Of the logarithm, over porosity. [-]
  double chance = 1.0;  ///< That of a slope as large, either way, in a model that is true.
};

/// (F26) Nothing where specimens are too few, or porosity differs too little beside what the
/// parameters make up for.
std::optional<PorosityTrend> porosity_trend(const PorositySample& sample);

/// The residuals do not follow porosity (F26).
Check check_porosity(const FitProblem& problem, const Answer& answer);

}  // namespace havers::calib
