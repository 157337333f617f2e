// All that follows from the slopes at the answer: what is determined, by which means it is known,
// and what would tell more.
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "calib/count.hpp"
#include "calib/fit/answer.hpp"
#include "calib/fit/confirmation.hpp"
#include "calib/fit/left_out.hpp"
#include "calib/fit/next_test.hpp"
#include "calib/fit/randomness.hpp"
#include "calib/fit/resampling.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;

const Unknown& unknown_of(const FitProblem& problem, const Answer& answer, Index column) {
  return problem.unknown(answer.active[static_cast<std::size_t>(column)]);
}

// "young_GPa × ratio^-0.31": a product of powers, of those that matter.
std::string product(const FitProblem& problem, const Answer& answer,
                    const Eigen::VectorXd& direction) {
  constexpr double matters = 0.1;  // the smallest exponent that is written
  std::string text;
  for (Index k = 0; k < direction.size(); ++k) {
    if (std::abs(direction[k]) < matters) continue;
    const Unknown& unknown = unknown_of(problem, answer, k);
    const bool plain = std::abs(direction[k] - 1.0) < 0.005;
    if (!text.empty()) text += " × ";
    // A parameter that is searched as it is (F1) enters as a power of e.
    if (unknown.info->scale != Scale::logarithmic)
      text += fmt::format("exp({:.2g} {})", direction[k], unknown.label);
    else
      text += plain ? unknown.label : fmt::format("{}^{:.2g}", unknown.label, direction[k]);
  }
  return text;
}

// ", at ratio = 1.5": where the slopes are those of, as what was asked for is left out there.
std::string where_held(const FitProblem& problem, const Answer& answer) {
  std::string text;
  for (const Index k : asked_and_left(problem, answer)) {
    const Unknown& unknown = problem.unknown(k);
    text += fmt::format("{} {} = {:.4g}{}{}", text.empty() ? ", at" : " and", unknown.label,
                        value_in_unit(unknown, answer.best.point[k]),
                        unknown.info->unit.empty() ? "" : " ", unknown.info->unit);
  }
  return text;
}

// (F20) Singular vectors of the Jacobian, scaled so that the largest exponent is 1.
std::vector<std::string> directions_of(const FitProblem& problem, const Answer& answer) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(answer.slopes.jacobian, Eigen::ComputeThinV);
  std::vector<std::string> sentences{fmt::format("The specimens determine {} of {}.", svd.rank(),
                                                 count(svd.singularValues().size(), "direction"))};
  for (Index i = 0; i < svd.singularValues().size(); ++i) {
    Index largest = 0;
    svd.matrixV().col(i).cwiseAbs().maxCoeff(&largest);
    const double scale = svd.matrixV()(largest, i);
    const Eigen::VectorXd direction = svd.matrixV().col(i) / scale;
    // Exponents are 1/scale times the unit vector, which is known to 1/(singular value).
    sentences.push_back(fmt::format(
        "{} is known to ± {:.2g} % (one standard error{}).", product(problem, answer, direction),
        100.0 / (svd.singularValues()[i] * std::abs(scale)), where_held(problem, answer)));
  }
  return sentences;
}

void set_correlation(const Answer& answer, CalibrationResult& result) {
  const Eigen::MatrixXd& follow = answer.uncertainty.follow;
  // (F11) (JᵀJ)⁻¹ = J⁺J⁺ᵀ.
  const Eigen::MatrixXd covariance = follow * follow.transpose();
  for (Index i = 0; i < covariance.rows(); ++i) {
    auto& row = result.correlation.emplace_back();
    for (Index j = 0; j < covariance.cols(); ++j)
      row.push_back(covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j)));
  }
}

// (F15) The profile's ends become the parameter's interval, with the bound in place of an end that
// the cost does not show; the bootstrap (F16) is told beside it.
void set_intervals(const FitProblem& problem, const Answer& answer, const Resampling& resampling,
                   CalibrationResult& result) {
  for (std::size_t i = 0; i < answer.active.size(); ++i) {
    const auto k = static_cast<Index>(i);
    const Unknown& unknown = unknown_of(problem, answer, k);
    auto& parameter =
        *std::ranges::find(result.parameters, unknown.label, &CalibratedParameter::name);
    const auto profile = std::ranges::find(answer.profiles, unknown.label, &Profile::parameter);
    if (profile == answer.profiles.end()) {
      parameter.profile_missing = "calibrate.options.profiles is false";
    } else {
      parameter.profile_95 = profile->interval_95;
      for (const std::size_t end : {0U, 1U}) {
        const bool risen = std::isfinite(profile->interval_95.at(end));
        parameter.interval_95.at(end) = (risen ? profile->interval_95 : parameter.bounds).at(end);
        if (!risen)
          parameter.profile_missing =
              "the cost does not rise enough between the answer and the bound";
      }
    }
    parameter.bootstrap_missing = resampling.missing;
    if (!resampling.missing.empty()) continue;
    // The step of a draw knows no bounds: ends are moved inside them.
    const auto end = [&](double shift) {
      const double at = answer.best.point[answer.active[i]] + shift;
      return value_in_unit(unknown, std::clamp(at, unknown.lower, unknown.upper));
    };
    parameter.bootstrap_95 = {end(resampling.lower[k]), end(resampling.upper[k])};
  }
}

// (F16) In standard errors; NaN where the other specimens do not determine the unknowns.
void set_influence(const FitProblem& problem, const Answer& answer, const Resampling& resampling,
                   CalibrationResult& result) {
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    auto& specimen = result.specimens[problem.fitted[f]];
    for (Index k = 0; k < resampling.left_out.cols(); ++k)
      specimen.influence.push_back(
          {unknown_of(problem, answer, k).label,
           resampling.left_out(static_cast<Index>(f), k) / answer.uncertainty.standard_error[k]});
  }
}

}  // namespace

void add_hindsight(const FitProblem& problem, SimulationBatch& batch, const Answer& answer,
                   CalibrationResult& result) {
  result.starts = answer.starts;
  for (const Evaluation& end : answer.ends) result.ends.push_back(end.cost);
  // Without slopes nothing of what follows can be said.
  if (answer.slopes.failed) return;
  for (Index k = 0; k < answer.slopes.jacobian.cols(); ++k)
    result.fitted.push_back(unknown_of(problem, answer, k).label);
  set_correlation(answer, result);
  result.directions = directions_of(problem, answer);
  result.profiles = answer.profiles;
  const Resampling resampling = resample(problem, answer);
  set_intervals(problem, answer, resampling, result);
  set_influence(problem, answer, resampling, result);
  result.randomness = randomness_of(batch, problem, answer);
  result.confirmations = confirm_in_time(batch, problem, answer);
  result.next_tests = next_tests(batch, problem, answer);
}

}  // namespace havers::calib
