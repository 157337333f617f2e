// The least-squares stage on NIST's certified regressions.
#include "calib/fit/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <sstream>

#include "tests/support/slow.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Certified {
  std::string name;
  std::array<VectorXd, 2> start;
  VectorXd value, deviation;
  VectorXd y;
  Eigen::MatrixXd x;
};

std::vector<Certified> certified_sets() {
  std::ifstream file(HAVERS_SOURCE_DIR "/tests/calib/fit/nist_strd.txt");
  std::string text;
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with('#')) text += line + "\n";
  std::istringstream in(text);
  std::vector<Certified> sets;
  Certified set;
  Index parameters = 0, rows = 0, predictors = 0;
  while (in >> set.name >> parameters >> rows >> predictors) {
    for (VectorXd* column : {set.start.data(), &set.start[1], &set.value, &set.deviation})
      column->resize(parameters);
    for (Index k = 0; k < parameters; ++k)
      in >> set.start[0][k] >> set.start[1][k] >> set.value[k] >> set.deviation[k];
    double sum_of_squares = 0.0;
    in >> sum_of_squares;
    set.y.resize(rows);
    set.x.resize(rows, predictors);
    for (Index i = 0; i < rows; ++i) {
      in >> set.y[i];
      for (Index j = 0; j < predictors; ++j) in >> set.x(i, j);
    }
    sets.push_back(set);
  }
  return sets;
}

// Of plain numbers: these tests are not optimised, and an Eigen element is a chain of calls then.
using Model = double (*)(const double* b, double x);

double decays(const double* b, double x) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-b[3] * x) + b[4] * std::exp(-b[5] * x);
}

double peaks(const double* b, double x) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-std::pow((x - b[3]) / b[4], 2)) +
         b[5] * std::exp(-std::pow((x - b[6]) / b[7], 2));
}

double cubic_over_cubic(const double* b, double x) {
  return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1.0 + x * (b[4] + x * (b[5] + x * b[6])));
}

double saturation(const double* b, double x) {
  return b[0] * (1.0 - std::exp(-b[1] * x));
}

double decay_over_line(const double* b, double x) {
  return std::exp(-b[0] * x) / (b[1] + b[2] * x);
}

double seasons(const double* b, double x) {
  const double turn = 2.0 * std::numbers::pi * x;
  return b[0] + b[1] * std::cos(turn / 12.0) + b[2] * std::sin(turn / 12.0) +
         b[4] * std::cos(turn / b[3]) + b[5] * std::sin(turn / b[3]) +
         b[7] * std::cos(turn / b[6]) + b[8] * std::sin(turn / b[6]);
}

const std::map<std::string, Model>& models() {
  static const std::map<std::string, Model> table{
      {"Bennett5",
       [](const double* b, double x) { return b[0] * std::pow(b[1] + x, -1.0 / b[2]); }},
      {"BoxBOD", saturation},
      {"Chwirut1", decay_over_line},
      {"Chwirut2", decay_over_line},
      {"DanWood", [](const double* b, double x) { return b[0] * std::pow(x, b[1]); }},
      {"ENSO", seasons},
      {"Eckerle4",
       [](const double* b, double x) {
         return b[0] / b[1] * std::exp(-0.5 * std::pow((x - b[2]) / b[1], 2));
       }},
      {"Gauss1", peaks},
      {"Gauss2", peaks},
      {"Gauss3", peaks},
      {"Hahn1", cubic_over_cubic},
      {"Kirby2",
       [](const double* b, double x) {
         return (b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4]));
       }},
      {"Lanczos1", decays},
      {"Lanczos2", decays},
      {"Lanczos3", decays},
      {"MGH09", [](const double* b,
                   double x) { return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]); }},
      {"MGH10", [](const double* b, double x) { return b[0] * std::exp(b[1] / (x + b[2])); }},
      {"MGH17",
       [](const double* b, double x) {
         return b[0] + b[1] * std::exp(-x * b[3]) + b[2] * std::exp(-x * b[4]);
       }},
      {"Misra1a", saturation},
      {"Misra1b", [](const double* b,
                     double x) { return b[0] * (1.0 - std::pow(1.0 + 0.5 * b[1] * x, -2.0)); }},
      {"Misra1c", [](const double* b,
                     double x) { return b[0] * (1.0 - 1.0 / std::sqrt(1.0 + 2.0 * b[1] * x)); }},
      {"Misra1d", [](const double* b, double x) { return b[0] * b[1] * x / (1.0 + b[1] * x); }},
      {"Rat42", [](const double* b, double x) { return b[0] / (1.0 + std::exp(b[1] - b[2] * x)); }},
      {"Rat43",
       [](const double* b, double x) {
         return b[0] * std::pow(1.0 + std::exp(b[1] - b[2] * x), -1.0 / b[3]);
       }},
      {"Roszman1",
       [](const double* b, double x) {
         return b[0] - b[1] * x - std::atan(b[2] / (x - b[3])) / std::numbers::pi;
       }},
      {"Thurber", cubic_over_cubic}};
  return table;
}

double nelson(const double* b, double time, double temperature) {
  return b[0] - b[1] * time * std::exp(-b[2] * temperature);
}

VectorXd residuals_of(const Certified& set, const VectorXd& point) {
  const double* const b = point.data();
  const auto rows = static_cast<std::size_t>(set.y.size());
  const std::span<const double> x(set.x.data(), rows), y(set.y.data(), rows);
  std::vector<double> residuals(rows);
  if (set.name == "Nelson") {
    const std::span<const double> second(set.x.col(1).data(), rows);
    for (std::size_t i = 0; i < rows; ++i)
      residuals[i] = nelson(b, x[i], second[i]) - std::log(y[i]);
  } else {
    const Model model = models().at(set.name);
    for (std::size_t i = 0; i < rows; ++i) residuals[i] = model(b, x[i]) - y[i];
  }
  return VectorXd::Map(residuals.data(), set.y.size());
}

LeastSquares problem_of(const Certified& set) {
  LeastSquares problem;
  problem.residuals = [&set](const std::vector<VectorXd>& points) {
    std::vector<VectorXd> all;
    for (const VectorXd& point : points) {
      all.push_back(residuals_of(set, point));
      if (!all.back().allFinite()) all.back().resize(0);
    }
    return all;
  };
  problem.lower = VectorXd::Constant(set.value.size(), -infinity);
  problem.upper = -problem.lower;
  return problem;
}

// Digits that agree, at most the eleven that are certified; of the worst parameter.
double digits(const VectorXd& found, const VectorXd& certified) {
  double least = 11.0;
  for (Index k = 0; k < found.size(); ++k) {
    const double off = std::abs(found[k] - certified[k]) / std::abs(certified[k]);
    least = std::min(least, off > 0.0 ? -std::log10(off) : 11.0);
  }
  return std::max(least, 0.0);
}

VectorXd standard_errors(const Eigen::MatrixXd& jacobian, const VectorXd& residuals) {
  const VectorXd scale = jacobian.colwise().norm().cwiseInverse();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian * scale.asDiagonal(), Eigen::ComputeThinV);
  const Eigen::MatrixXd root = svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal();
  const auto freedom = static_cast<double>(jacobian.rows() - jacobian.cols());
  return root.rowwise().norm().cwiseProduct(scale) * residuals.norm() / std::sqrt(freedom);
}

constexpr LeastSquaresOptions exact{.step = 5e-4,
                                    .relative = true,
                                    .stencil = 4,
                                    .max_iterations = 10000,
                                    .cost_tolerance = 1e-16,
                                    .step_tolerance = 1e-16};

// A bold first step may leap onto a plateau, where an unknown has no effect any more.
LeastSquaresResult better_of_two(const LeastSquares& problem, const VectorXd& start) {
  LeastSquaresOptions cautious = exact;
  cautious.trust_radius = 1e-3;
  const auto bold = least_squares(problem, start, exact);
  const auto slow = least_squares(problem, start, cautious);
  return bold.cost <= (1.0 + 1e-9) * slow.cost ? bold : slow;
}

TEST(LeastSquares, FindsNistsCertifiedValues) {
  HAVERS_SLOW;
  const auto sets = certified_sets();
  ASSERT_EQ(sets.size(), 27U);
  double sum = 0.0;
  for (const Certified& set : sets)
    for (const VectorXd& start : set.start) {
      const auto problem = problem_of(set);
      const auto found = better_of_two(problem, start);
      const double agree = digits(found.best, set.value);
      EXPECT_GE(agree, 4.0) << set.name << " " << found.message;
      sum += agree;
      // Lanczos1's residuals are those of rounding; so would be its standard errors.
      if (set.name == "Lanczos1") continue;
      const auto jacobian = difference_jacobian(problem, found.best, found.residuals, exact);
      EXPECT_GE(digits(standard_errors(jacobian, found.residuals), set.deviation), 4.0) << set.name;
    }
  RecordProperty("mean_digits", std::to_string(sum / 54.0));
  EXPECT_GE(sum / 54.0, 9.4);
}

}  // namespace
}  // namespace havers::calib
