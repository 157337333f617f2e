// (F18) Information adds: errors after a further test are those of JᵀJ of the answer and the rows
// of one more specimen, which are known before it is made.
#include "calib/fit/next_test.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/fit/specimen_effect.hpp"
#include "calib/fit/specimen_slopes.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double faster_by = 10.0;  // of a test at another rate

MatrixXd rows_of(const Answer& answer, std::size_t fitted) {
  return answer.slopes.jacobian.middleRows<landmark_count>(first_row(fitted));
}

double distance(const FitProblem& problem, std::size_t fitted, double orientation) {
  return std::abs(problem.study.specimens[problem.fitted[fitted]].orientation - orientation);
}

// The fitted specimen nearest to an orientation, which one that does not exist is made from: one
// that broke, if there is one there, and of equals the first by its id.
std::size_t nearest(const FitProblem& problem, double orientation) {
  const auto rank = [&](std::size_t f) {
    const bool stopped = !problem.study.specimens[problem.fitted[f]].broke;
    return std::pair(distance(problem, f, orientation), stopped);
  };
  std::size_t best = 0;
  for (std::size_t f = 1; f < problem.fitted.size(); ++f)
    if (rank(f) < rank(best)) best = f;
  return best;
}

// Rows of the Jacobian of a specimen that does not exist, measured like specimen `like` of the
// study: as much of it counts.
MatrixXd simulated_rows(SimulationBatch& batch, const FitProblem& problem, const Answer& answer,
                        std::size_t like, const Specimen& specimen) {
  MatrixXd rows = specimen_slopes(batch, problem, answer, specimen, like);
  for (Index q = 0; q < rows.rows(); ++q)
    rows.row(q) *= problem.targets[like].present[q] ? 1.0 / answer.weights.sd[like][q] : 0.0;
  return rows;
}

// A specimen that does not exist has no value of a parameter that differs between specimens.
bool all_shared(const FitProblem& problem) {
  return std::ranges::all_of(problem.unknowns,
                             [](const Unknown& u) { return u.level == Level::shared; });
}

// A further specimen has values of its own of what differs between specimens: its rows tell those
// of no other, and of what they share only what its own do not follow.
MatrixXd rows_of_another(const FitProblem& problem, const Answer& answer, std::size_t like) {
  MatrixXd rows = rows_of(answer, like);
  std::vector<Index> own;
  for (Index k = 0; k < rows.cols(); ++k)
    if (problem.unknown(answer.active[static_cast<std::size_t>(k)]).level == Level::specimen)
      own.push_back(k);
  const MatrixXd columns = rows(Eigen::all, own);
  for (Index k = 0; k < rows.cols(); ++k) rows.col(k) -= followed(columns, rows.col(k));
  return rows;
}

// Slopes of one more specimen at an orientation; empty where they cannot be had.
MatrixXd further_rows(SimulationBatch& batch, const FitProblem& problem, const Answer& answer,
                      double orientation) {
  const std::size_t near = nearest(problem, orientation);
  // A specimen that the study has there need not be simulated.
  if (distance(problem, near, orientation) < degree) return rows_of_another(problem, answer, near);
  if (!all_shared(problem)) return {};
  Specimen turned = problem.study.specimens[problem.fitted[near]];
  turned.orientation = orientation;
  // Its seeds follow from its id (F2).
  turned.id = fmt::format("next at {:.4g}", orientation / degree);
  return simulated_rows(batch, problem, answer, problem.fitted[near], turned);
}

// A specimen once more, pulled faster. In the quasi-static limit it is the same test.
MatrixXd faster_rows(SimulationBatch& batch, const FitProblem& problem, const Answer& answer,
                     std::size_t like) {
  Specimen faster = problem.study.specimens[like];
  if (!all_shared(problem) || !(faster.test.strain_rate > 0.0)) return {};
  faster.test.strain_rate *= faster_by;
  return simulated_rows(batch, problem, answer, like, faster);
}

// Standard errors by JᵀJ, which is regular: every unknown in it is informed.
std::vector<double> errors(const MatrixXd& normal) {
  const MatrixXd inverse = normal.ldlt().solve(MatrixXd::Identity(normal.rows(), normal.cols()));
  std::vector<double> result;
  for (Index k = 0; k < inverse.rows(); ++k) result.push_back(std::sqrt(inverse(k, k)));
  return result;
}

NextTest compared(std::string what, const MatrixXd& now, const MatrixXd& then) {
  NextTest test{.what = std::move(what)};
  const auto before = errors(now), after = errors(then);
  for (std::size_t k = 0; k < before.size(); ++k) test.width.push_back(after[k] / before[k]);
  return test;
}

// JᵀJ if every specimen had one more section.
MatrixXd with_more_sections(const FitProblem& problem, const Answer& answer) {
  const auto count = answer.slopes.jacobian.cols();
  MatrixXd normal = MatrixXd::Zero(count, count);
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const auto sections = static_cast<double>(problem.study.specimens[s].sections.size());
    // The variance by the scatter is proportional to 1/sections: one more than n saves 1/(n + 1) of
    // it.
    const Landmarks saved =
        answer.weights.scatter[s].square() * (sections > 0.0 ? 1.0 / (sections + 1.0) : 0.0);
    const Landmarks variance = answer.weights.sd[s].square();
    const MatrixXd rows =
        (variance / (variance - saved)).sqrt().matrix().asDiagonal() * rows_of(answer, f);
    normal += rows.transpose() * rows;
  }
  return normal;
}

}  // namespace

std::vector<NextTest> next_tests(SimulationBatch& batch, const FitProblem& problem,
                                 const Answer& answer) {
  const auto& jacobian = answer.slopes.jacobian;
  const MatrixXd now = jacobian.transpose() * jacobian;
  std::vector<NextTest> tests;
  for (const double degrees : {0.0, 45.0, 90.0}) {
    const MatrixXd rows = further_rows(batch, problem, answer, degrees * degree);
    if (rows.size() == 0) continue;
    tests.push_back(compared(fmt::format("one more specimen at {:g} deg", degrees), now,
                             now + rows.transpose() * rows));
  }
  const std::size_t along = problem.fitted[nearest(problem, 0.0)];
  if (const MatrixXd rows = faster_rows(batch, problem, answer, along); rows.size() > 0)
    tests.push_back(
        compared(fmt::format("one more specimen at {:.4g} deg, {:g} times as fast",
                             problem.study.specimens[along].orientation / degree, faster_by),
                 now, now + rows.transpose() * rows));
  const bool have_sections = std::ranges::any_of(
      problem.fitted, [&](std::size_t s) { return (answer.weights.scatter[s] > 0.0).any(); });
  if (have_sections)
    tests.push_back(
        compared("one more section of every specimen", now, with_more_sections(problem, answer)));
  return tests;
}

}  // namespace havers::calib
