// The least-squares stage inside bounds, on the test functions of Moré, Garbow and Hillstrom, and
// where residuals cannot be had.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "calib/fit/least_squares.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A function of Moré, Garbow and Hillstrom, with the bounds and optima of Gay.
struct Bounded {
  const char* name;
  std::vector<double> start, lower, upper;
  double sum_of_squares;  // at the optimum inside the bounds
  bool reached;           // false: a local minimum or a corner of the bounds stops the search
  VectorXd (*residuals)(const VectorXd& x);
};

constexpr LeastSquaresOptions to_the_last_digit{.step = 1e-6,
                                                .max_iterations = 10000,
                                                .cost_tolerance = 1e-16,
                                                .search_steps = true,
                                                .step_tolerance = 1e-16};

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

TEST(BoundedLeastSquares, NeverLeavesTheBoundsOnTheWayToTheOptimumInside) {
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
    const auto found = least_squares(problem, as_vector(bounded.start), to_the_last_digit);
    EXPECT_EQ(outside, 0);
    EXPECT_LT(found.cost, 0.5 * bounded.residuals(as_vector(bounded.start)).squaredNorm());
    if (!bounded.reached) continue;
    EXPECT_NEAR(2.0 * found.cost, bounded.sum_of_squares, 1e-4 * bounded.sum_of_squares + 1e-12)
        << found.message;
  }
}

TEST(BoundedLeastSquares, TakesOneSidedDifferencesAtABoundAndBesideFailures) {
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

TEST(BoundedLeastSquares, SaysThatTheStartFails) {
  LeastSquares problem{.lower = vector({0.0}), .upper = vector({1.0})};
  problem.residuals = [](const std::vector<VectorXd>& points) {
    return std::vector<VectorXd>(points.size());
  };
  EXPECT_TRUE(least_squares(problem, vector({0.5})).failed);
}

}  // namespace
}  // namespace havers::calib
