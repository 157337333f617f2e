// The least-squares stage on problems that know their answer: NIST's certified regressions, and the
// test functions of Moré, Garbow and Hillstrom inside bounds.
#include "calib/fit/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

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

using Model = double (*)(const VectorXd& b, double x);

double decays(const VectorXd& b, double x) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-b[3] * x) + b[4] * std::exp(-b[5] * x);
}

double peaks(const VectorXd& b, double x) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-std::pow((x - b[3]) / b[4], 2)) +
         b[5] * std::exp(-std::pow((x - b[6]) / b[7], 2));
}

double cubic_over_cubic(const VectorXd& b, double x) {
  return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1.0 + x * (b[4] + x * (b[5] + x * b[6])));
}

double saturation(const VectorXd& b, double x) {
  return b[0] * (1.0 - std::exp(-b[1] * x));
}

double decay_over_line(const VectorXd& b, double x) {
  return std::exp(-b[0] * x) / (b[1] + b[2] * x);
}

double seasons(const VectorXd& b, double x) {
  const double turn = 2.0 * std::numbers::pi * x;
  return b[0] + b[1] * std::cos(turn / 12.0) + b[2] * std::sin(turn / 12.0) +
         b[4] * std::cos(turn / b[3]) + b[5] * std::sin(turn / b[3]) +
         b[7] * std::cos(turn / b[6]) + b[8] * std::sin(turn / b[6]);
}

const std::map<std::string, Model>& models() {
  static const std::map<std::string, Model> table{
      {"Bennett5",
       [](const VectorXd& b, double x) { return b[0] * std::pow(b[1] + x, -1.0 / b[2]); }},
      {"BoxBOD", saturation},
      {"Chwirut1", decay_over_line},
      {"Chwirut2", decay_over_line},
      {"DanWood", [](const VectorXd& b, double x) { return b[0] * std::pow(x, b[1]); }},
      {"ENSO", seasons},
      {"Eckerle4",
       [](const VectorXd& b, double x) {
         return b[0] / b[1] * std::exp(-0.5 * std::pow((x - b[2]) / b[1], 2));
       }},
      {"Gauss1", peaks},
      {"Gauss2", peaks},
      {"Gauss3", peaks},
      {"Hahn1", cubic_over_cubic},
      {"Kirby2",
       [](const VectorXd& b, double x) {
         return (b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4]));
       }},
      {"Lanczos1", decays},
      {"Lanczos2", decays},
      {"Lanczos3", decays},
      {"MGH09", [](const VectorXd& b,
                   double x) { return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]); }},
      {"MGH10", [](const VectorXd& b, double x) { return b[0] * std::exp(b[1] / (x + b[2])); }},
      {"MGH17",
       [](const VectorXd& b, double x) {
         return b[0] + b[1] * std::exp(-x * b[3]) + b[2] * std::exp(-x * b[4]);
       }},
      {"Misra1a", saturation},
      {"Misra1b", [](const VectorXd& b,
                     double x) { return b[0] * (1.0 - std::pow(1.0 + 0.5 * b[1] * x, -2.0)); }},
      {"Misra1c", [](const VectorXd& b,
                     double x) { return b[0] * (1.0 - 1.0 / std::sqrt(1.0 + 2.0 * b[1] * x)); }},
      {"Misra1d", [](const VectorXd& b, double x) { return b[0] * b[1] * x / (1.0 + b[1] * x); }},
      {"Rat42",
       [](const VectorXd& b, double x) { return b[0] / (1.0 + std::exp(b[1] - b[2] * x)); }},
      {"Rat43",
       [](const VectorXd& b, double x) {
         return b[0] * std::pow(1.0 + std::exp(b[1] - b[2] * x), -1.0 / b[3]);
       }},
      {"Roszman1",
       [](const VectorXd& b, double x) {
         return b[0] - b[1] * x - std::atan(b[2] / (x - b[3])) / std::numbers::pi;
       }},
      {"Thurber", cubic_over_cubic}};
  return table;
}

VectorXd residuals_of(const Certified& set, const VectorXd& b) {
  VectorXd residuals(set.y.size());
  for (Index i = 0; i < set.y.size(); ++i)
    residuals[i] =
        set.name == "Nelson"
            ? b[0] - b[1] * set.x(i, 0) * std::exp(-b[2] * set.x(i, 1)) - std::log(set.y[i])
            : models().at(set.name)(b, set.x(i, 0)) - set.y[i];
  return residuals;
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
                                    .second_try = true,
                                    .search_steps = true,
                                    .step_tolerance = 1e-16};

TEST(LeastSquares, FindsNistsCertifiedValues) {
  const auto sets = certified_sets();
  ASSERT_EQ(sets.size(), 27U);
  double sum = 0.0;
  for (const Certified& set : sets)
    for (const VectorXd& start : set.start) {
      const auto problem = problem_of(set);
      const auto found = least_squares(problem, start, exact);
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

/// A function of Moré, Garbow and Hillstrom, with the bounds and optima of Gay.
struct Bounded {
  const char* name;
  std::vector<double> start, lower, upper;
  double sum_of_squares;  // at the optimum inside the bounds
  bool reached;           // false: a local minimum or a corner of the bounds stops the search
  VectorXd (*residuals)(const VectorXd& x);
};

VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

VectorXd helical_valley(const VectorXd& x) {
  double turn = std::atan(x[1] / x[0]) / (2.0 * std::numbers::pi);
  if (x[0] < 0.0) turn += 0.5;
  return vector({10.0 * (x[2] - 10.0 * turn), 10.0 * (std::hypot(x[0], x[1]) - 1.0), x[2]});
}

VectorXd gaussian(const VectorXd& x) {
  const std::array y{0.0009, 0.0044, 0.0175, 0.0540, 0.1295, 0.2420, 0.3521, 0.3989,
                     0.3521, 0.2420, 0.1295, 0.0540, 0.0175, 0.0044, 0.0009};
  VectorXd residuals(15);
  for (Index i = 0; i < 15; ++i) {
    const double t = 0.5 * (7.0 - static_cast<double>(i));
    residuals[i] =
        x[0] * std::exp(-0.5 * x[1] * std::pow(t - x[2], 2)) - y[static_cast<std::size_t>(i)];
  }
  return residuals;
}

VectorXd box(const VectorXd& x) {
  VectorXd residuals(3);
  for (Index i = 0; i < 3; ++i) {
    const double t = 0.1 * static_cast<double>(i + 1);
    residuals[i] =
        std::exp(-t * x[0]) - std::exp(-t * x[1]) - x[2] * (std::exp(-t) - std::exp(-10.0 * t));
  }
  return residuals;
}

VectorXd brown_and_dennis(const VectorXd& x) {
  VectorXd residuals(20);
  for (Index i = 0; i < 20; ++i) {
    const double t = 0.2 * static_cast<double>(i + 1);
    residuals[i] = std::pow(x[0] + t * x[1] - std::exp(t), 2) +
                   std::pow(x[2] + x[3] * std::sin(t) - std::cos(t), 2);
  }
  return residuals;
}

VectorXd biggs(const VectorXd& x) {
  VectorXd residuals(13);
  for (Index i = 0; i < 13; ++i) {
    const double t = 0.1 * static_cast<double>(i + 1);
    const double y = std::exp(-t) - 5.0 * std::exp(-10.0 * t) + 3.0 * std::exp(-4.0 * t);
    residuals[i] =
        x[2] * std::exp(-t * x[0]) - x[3] * std::exp(-t * x[1]) + x[5] * std::exp(-t * x[4]) - y;
  }
  return residuals;
}

VectorXd wood(const VectorXd& x) {
  return vector({10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0], std::sqrt(90.0) * (x[3] - x[2] * x[2]),
                 1.0 - x[2], std::sqrt(10.0) * (x[1] + x[3] - 2.0),
                 (x[1] - x[3]) / std::sqrt(10.0)});
}

const std::vector<Bounded>& bounded_problems() {
  static const std::vector<Bounded> problems{
      {"Powell's badly scaled",
       {0.0, 1.0},
       {0.0, 1.0},
       {1.0, 9.0},
       0.15125900e-9,
       true,
       [](const VectorXd& x) {
         return vector({1e4 * x[0] * x[1] - 1.0, std::exp(-x[0]) + std::exp(-x[1]) - 1.0001});
       }},
      {"Brown's badly scaled",
       {1.0, 1.0},
       {0.0, 3e-5},
       {1e6, 100.0},
       0.784e3,
       true,
       [](const VectorXd& x) {
         return vector({x[0] - 1e6, x[1] - 2e-6, x[0] * x[1] - 2.0});
       }},
      {"Beale",
       {1.0, 1.0},
       {0.6, 0.5},
       {10.0, 100.0},
       0.0,
       true,
       [](const VectorXd& x) {
         return vector({1.5 - x[0] * (1.0 - x[1]), 2.25 - x[0] * (1.0 - x[1] * x[1]),
                        2.625 - x[0] * (1.0 - std::pow(x[1], 3))});
       }},
      {"helical valley",
       {-1.0, 0.0, 0.0},
       {-100.0, -1.0, -1.0},
       {0.8, 1.0, 1.0},
       0.99042212,
       false,
       helical_valley},
      {"Gaussian",
       {0.4, 1.0, 0.0},
       {0.398, 1.0, -0.5},
       {4.2, 2.0, 0.1},
       0.112793e-7,
       true,
       gaussian},
      {"Box", {0.0, 10.0, 20.0}, {0.0, 5.0, 0.0}, {2.0, 9.5, 20.0}, 0.30998153e-5, false, box},
      {"Wood",
       {-3.0, -1.0, -3.0, -1.0},
       {-100.0, -100.0, -100.0, -100.0},
       {0.0, 10.0, 100.0, 100.0},
       1.5567008,
       true,
       wood},
      {"Brown and Dennis",
       {25.0, 5.0, -5.0, -1.0},
       {-10.0, 0.0, -100.0, -20.0},
       {100.0, 15.0, 0.0, 0.2},
       0.88860479e5,
       false,
       brown_and_dennis},
      {"Biggs EXP6",
       {1.0, 2.0, 1.0, 1.0, 1.0, 1.0},
       {0.0, 0.0, 0.0, 1.0, 0.0, 0.0},
       {2.0, 8.0, 1.0, 7.0, 5.0, 5.0},
       0.53209865e-3,
       false,
       biggs}};
  return problems;
}

TEST(LeastSquares, NeverLeavesTheBoundsOnTheWayToTheOptimumInside) {
  for (const Bounded& bounded : bounded_problems()) {
    SCOPED_TRACE(bounded.name);
    const auto as_vector = [](const std::vector<double>& values) {
      return VectorXd(Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size())));
    };
    LeastSquares problem{.lower = as_vector(bounded.lower), .upper = as_vector(bounded.upper)};
    long outside = 0;
    problem.residuals = [&](const std::vector<VectorXd>& points) {
      std::vector<VectorXd> all;
      for (const VectorXd& point : points) {
        const bool inside = (point.array() >= problem.lower.array()).all() &&
                            (point.array() <= problem.upper.array()).all();
        outside += inside ? 0 : 1;
        all.push_back(bounded.residuals(point));
      }
      return all;
    };
    auto options = exact;
    options.stencil = 2;
    options.step = 1e-6;
    options.relative = false;
    const auto found = least_squares(problem, as_vector(bounded.start), options);
    EXPECT_EQ(outside, 0);
    EXPECT_LT(found.cost, 0.5 * bounded.residuals(as_vector(bounded.start)).squaredNorm());
    if (!bounded.reached) continue;
    EXPECT_NEAR(2.0 * found.cost, bounded.sum_of_squares, 1e-4 * bounded.sum_of_squares + 1e-12)
        << found.message;
  }
}

TEST(LeastSquares, TakesOneSidedDifferencesAtABoundAndBesideFailures) {
  LeastSquares problem{.lower = VectorXd::Constant(2, 1.0), .upper = VectorXd::Constant(2, 3.0)};
  problem.residuals = [](const std::vector<VectorXd>& points) {
    std::vector<VectorXd> all;
    for (const VectorXd& x : points)
      all.push_back(x[1] > 2.0 ? VectorXd() : vector({2.0 * x[0] + 5.0 * x[1]}));
    return all;
  };
  const auto jacobian = difference_jacobian(problem, vector({1.0, 2.0}), vector({12.0}));
  EXPECT_NEAR(jacobian(0, 0), 2.0, 1e-12);
  EXPECT_NEAR(jacobian(0, 1), 5.0, 1e-12);
}

TEST(LeastSquares, SaysThatTheStartFails) {
  LeastSquares problem{.lower = vector({0.0}), .upper = vector({1.0})};
  problem.residuals = [](const std::vector<VectorXd>& points) {
    return std::vector<VectorXd>(points.size());
  };
  EXPECT_TRUE(least_squares(problem, vector({0.5})).failed);
}

}  // namespace
}  // namespace havers::calib
