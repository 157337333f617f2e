#include "calib/fit/specimen_effect.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace havers::calib {
namespace {

double chi_squared(const Sample& sample, double between) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sample.difference.size(); ++i)
    sum += sample.difference[i] * sample.difference[i] / (sample.variance[i] + between);
  return sum;
}

}  // namespace

// chi_squared falls with `between`: bisection in the variance.
double variance_between(const Sample& sample, double freedom) {
  if (freedom < least_freedom || chi_squared(sample, 0.0) <= freedom) return 0.0;
  double low = 0.0, high = 0.0;
  for (const double difference : sample.difference) high += difference * difference / freedom;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_squared(sample, middle) > freedom ? low : high) = middle;
  }
  return high;
}

Landmarks parameters_spent(const Eigen::MatrixXd& jacobian) {
  Landmarks spent = Landmarks::Zero();
  if (jacobian.cols() == 0) return spent;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU);
  for (Eigen::Index row = 0; row < jacobian.rows(); ++row)
    spent[row % landmark_count] += svd.matrixU().row(row).head(svd.rank()).squaredNorm();
  return spent;
}

Landmarks specimen_effect(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                          const Eigen::MatrixXd& jacobian) {
  const Landmarks spent = parameters_spent(jacobian);
  Landmarks effect = Landmarks::Zero();
  for (Eigen::Index q = 0; q < landmark_count; ++q) {
    Sample sample;
    for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
      const std::size_t s = problem.fitted[f];
      if (!tells(at.predictions[f], problem.targets[s])[q]) continue;
      sample.difference.push_back(difference(at.predictions[f], problem.targets[s])[q]);
      sample.variance.push_back(std::pow(weights.sd[s][q], 2) - std::pow(weights.specimen[q], 2));
    }
    const double freedom = static_cast<double>(sample.difference.size()) - spent[q];
    effect[q] = std::sqrt(variance_between(sample, freedom));
  }
  return effect;
}

}  // namespace havers::calib
