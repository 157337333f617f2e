// Linear laws of what a sweep measured, by least squares (W1).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "calib/sweep/measure.hpp"

namespace havers::calib {

/// response = Σ coefficient · term + constant, one law for each value of the key `per`.
struct LawRequest {
  Measure response = Measure::failure_strain;
  std::vector<std::string> terms;  ///< Keys of the sweep, with numbers.
  std::string per;                 ///< Empty: one law.
};

/// Whether a law is fitted, or why it is not; unless it is, its numbers mean nothing.
enum class LawStatus { fitted, too_few_runs, terms_do_not_vary, unbroken_runs };

/// A law fitted to the runs of one group of points.
struct Law {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();  ///< Of no fitted law.
  LawRequest request;
  std::string at;  ///< The value of `per`.
  LawStatus status = LawStatus::too_few_runs;
  std::vector<double> coefficients;     ///< Those of the terms, then the constant. SI units.
  std::vector<double> standard_errors;  ///< Of each, from the replicates.
  double confidence_factor = none;      ///< Half a 95 % interval over the standard error. [-]
  double residual_sd = none;            ///< Of the runs around the law. SI units.
  double explained = none;              ///< R². [-]
  long runs = 0;
  std::vector<std::size_t> points;

  // Lack of fit (W2): the points' means around the law against the runs around their means.
  double lack_of_fit = none;    ///< F; NaN where it cannot be tested. [-]
  double lack_of_fit_p = none;  ///< Its probability if the law held. [-]

  /// The response that the law gives at a point of the sweep. SI units. Precondition: the law has
  /// coefficients.
  [[nodiscard]] double value(const SweepPoint& point, const SweepPlan& plan) const;
};

std::string explain(LawStatus status);

/// Whether a group of points tells the terms of a law and its constant apart, and has a point more
/// than these to try the law by.
bool tries_law(const LawRequest& request, const SweepPlan& plan,
               const std::vector<SweepPoint>& points, const PointGroup& group);

/// The laws asked for, fitted to the runs that did not fail; to none where one did not break.
std::vector<Law> fit_laws(const LawRequest& request, const SweepPlan& plan,
                          const std::vector<SweepPoint>& points, const std::vector<SweepRun>& runs);

}  // namespace havers::calib
