// A study made ready for calibration, and the residuals of its specimens.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <set>
#include <vector>

#include "calib/fit/prediction.hpp"
#include "calib/fit/scenes.hpp"
#include "calib/fit/simulation_batch.hpp"
#include "calib/fit/target.hpp"
#include "calib/fit/unknowns.hpp"

namespace havers::calib {

/// All that stays the same during a calibration.
struct FitProblem {
  const Study& study;  ///< Not owned.
  std::vector<Unknown> unknowns;
  std::vector<SpecimenModel> models{};  ///< One per specimen of the study.
  std::vector<Target> targets{};        ///< One per specimen of the study.
  /// Specimens that are fitted and whose test is usable, by their ids: the order in which a study
  /// names them changes nothing.
  std::vector<std::size_t> fitted{};

  /// The unknown whose position is the k-th of a point.
  [[nodiscard]] const Unknown& unknown(Eigen::Index k) const {
    return unknowns[static_cast<std::size_t>(k)];
  }
};
/// The study has to outlive it.
FitProblem make_problem(const Study& study);

/// The scenes of a specimen at a point, one per replicate. Where the post-peak drop is a term of
/// the study, they go on until the stress has fallen.
std::vector<sim::Scene> replicate_scenes(const FitProblem& problem, const Point& point,
                                         std::size_t specimen, int replicates);

/// Standard deviation of each residual, by source (F6). One Landmarks per specimen of the study; 0
/// for those that are not fitted.
struct Weights {
  std::vector<Landmarks>
      replicates;  ///< The specimen is one draw, the model's mean is of n: sd·√(1+1/n).
  std::vector<Landmarks> scatter;          ///< By the standard error of the specimen's scatter.
  Landmarks specimen = Landmarks::Zero();  ///< Between specimens, beyond everything else (F9).
  std::vector<Landmarks> sd;               ///< All of them and the machine's noise together.
};

/// Variances of a specimen's residuals if specimens were alike.
Landmarks variance_if_alike(const Weights& weights, std::size_t specimen);

/// Replicates of a specimen, as many as there are before it is known how many are needed.
int all_replicates(const CalibrateOptions& options);

/// Where the landmark_count rows of the f-th fitted specimen begin, of residuals and of Jacobians.
constexpr Eigen::Index first_row(std::size_t f) {
  return landmark_count * static_cast<Eigen::Index>(f);
}

/// One point of a search.
struct Evaluation {
  Point point;
  bool failed = true;                   ///< Too many simulations of a specimen failed.
  std::vector<Prediction> predictions;  ///< One per fitted specimen.
  Eigen::VectorXd residuals;  ///< Standardised, landmark_count per fitted specimen (F7). [-]
  double cost = std::numeric_limits<double>::infinity();  ///< ½ Σ residual². [-]
};

/// Simulates every fitted specimen at every point, as one batch. Residuals are left to `score`.
std::vector<Evaluation> predict(const FitProblem& problem, SimulationBatch& batch,
                                const std::vector<Point>& points, int replicates);

/// Residuals and cost of an evaluation (F7), from its predictions; failed where the cost is no
/// number.
void score(const FitProblem& problem, const Weights& weights, Evaluation& evaluation);

/// simulated − measured, or − the bound of a test that was stopped; 0 where the test does not have
/// the landmark, and where a strength that simulations did not reach contradicts nothing. [-]
Landmarks difference(const Prediction& prediction, const Target& target);

/// Standardised by given standard deviations (F7); that of a bound is (F25). [-]
Landmarks residuals_of(const Prediction& prediction, const Target& target, const Landmarks& sd);

/// What these change by for each standard deviation of the difference: 1, less for bounds, 0 where
/// nothing is told. [-]
Landmarks slopes_of_residuals(const Prediction& prediction, const Target& target,
                              const Landmarks& sd);

/// Whether the test was stopped and simulations break, so that its strength bounds theirs.
bool has_bound(const Prediction& prediction, const Target& target);

/// The landmarks of a specimen that tell how much specimens differ: present, and no bound of the
/// test, nor one of the simulations that is not contradicted.
Eigen::Array<bool, landmark_count, 1> tells(const Prediction& prediction, const Target& target);

/// How many fitted specimens tell so of each landmark.
Landmarks residuals_told(const FitProblem& problem, const Evaluation& at);

/// Orientations at which stopped tests tell of the strength: those that broke there are the weaker
/// ones, which no check may take for all. [rad]
std::set<double> one_sided_orientations(const FitProblem& problem, const Evaluation& at);

/// How much the standard errors of what its porosity makes (its scatter, where that is not
/// searched, or its missing joints, and the factor on its modulus) move a specimen (F6), by
/// simulation at other ones; zero where they are known exactly.
/// @param here  what is simulated at the point
Landmarks porosity_error(const FitProblem& problem, SimulationBatch& batch, const Point& point,
                         std::size_t specimen, const Prediction& here);

/// The weights (F6), with the replicates' spread at a point.
/// @param scatter   of each specimen of the study, from `porosity_error`.
/// @param specimen  sd between specimens, from `specimen_effect`.
Weights weigh(const FitProblem& problem, const Evaluation& at, std::vector<Landmarks> scatter,
              const Landmarks& specimen);

}  // namespace havers::calib
