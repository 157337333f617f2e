// (F9) τ by Paule and Mandel, and what parameters spend of the residuals that tell it, by the
// leverage of their rows.
#include "calib/fit/specimen_effect.hpp"

#include <Eigen/QR>
#include <cmath>

#include "calib/fit/bound.hpp"

namespace havers::calib {
namespace {

// Of specimens that differ by a variance `between`; a bound adds −z φ/Φ where others add a square
// (F25).
double chi_squared(const Sample& sample, double between) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sample.difference.size(); ++i)
    sum += sample.difference[i] * sample.difference[i] / (sample.variance[i] + between);
  for (std::size_t i = 0; i < sample.above.size(); ++i)
    sum -= square_of_bound(sample.above[i] / std::sqrt(sample.variance_above[i] + between));
  return sum;
}

// An orthonormal base of what the columns span.
Eigen::MatrixXd column_space(const Eigen::MatrixXd& matrix) {
  if (matrix.cols() == 0) return matrix;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  return qr.householderQ() * Eigen::MatrixXd::Identity(matrix.rows(), qr.rank());
}

}  // namespace

// chi_squared falls to nothing in the end: bisection in the variance.
double variance_between(const Sample& sample, double freedom) {
  if (freedom < least_freedom || chi_squared(sample, 0.0) <= freedom) return 0.0;
  double low = 0.0, high = 0.0;
  // At this variance the differences add less than the freedom; bounds may still add more, and then
  // it is doubled.
  for (const double difference : sample.difference) high += difference * difference / freedom;
  for (const double above : sample.above) high += above * above / freedom;
  while (chi_squared(sample, high) > freedom) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_squared(sample, middle) > freedom ? low : high) = middle;
  }
  return high;
}

Eigen::VectorXd leverage(const Eigen::MatrixXd& jacobian) {
  return column_space(jacobian).rowwise().squaredNorm();
}

Eigen::VectorXd followed(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals) {
  const Eigen::MatrixXd space = column_space(jacobian);
  const Eigen::VectorXd along = space.transpose() * residuals;
  return space * along;
}

Landmarks parameters_spent(const FitProblem& problem, const Evaluation& at,
                           const Eigen::MatrixXd& jacobian) {
  Landmarks spent = Landmarks::Zero();
  const Eigen::VectorXd of_row = leverage(jacobian);
  for (std::size_t f = 0; f < problem.fitted.size(); ++f)
    spent += tells(at.predictions[f], problem.targets[problem.fitted[f]])
                 .select(of_row.segment<landmark_count>(first_row(f)).array(), 0.0);
  return spent;
}

Landmarks specimen_effect(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                          const Eigen::MatrixXd& jacobian) {
  const Landmarks spent = parameters_spent(problem, at, jacobian);
  Landmarks effect = Landmarks::Zero();
  for (Eigen::Index q = 0; q < landmark_count; ++q) {
    Sample sample;
    for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
      const std::size_t s = problem.fitted[f];
      const auto& prediction = at.predictions[f];
      const auto& target = problem.targets[s];
      // A bound adds to the sum, and is not counted among the degrees of freedom.
      const bool bound = q == strength && has_bound(prediction, target);
      if (!bound && !tells(prediction, target)[q]) continue;
      (bound ? sample.above : sample.difference).push_back(difference(prediction, target)[q]);
      (bound ? sample.variance_above : sample.variance).push_back(variance_if_alike(weights, s)[q]);
    }
    const double freedom = static_cast<double>(sample.difference.size()) - spent[q];
    effect[q] = std::sqrt(variance_between(sample, freedom));
  }
  return effect;
}

}  // namespace havers::calib
