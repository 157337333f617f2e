// (F16) Other specimens by one step with the slopes at the answer: each specimen has its JᵀJ and
// Jᵀr, and a draw sums these, which costs no simulation.
#include "calib/fit/resampling.hpp"

#include <Random123/philox.h>
#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "calib/count.hpp"
#include "calib/fit/specimen_effect.hpp"

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int draws = 999;
constexpr std::size_t fewest_specimens = 5;
constexpr double most_singular = 0.2;  // part of the draws that may not determine an unknown

/// JᵀJ and Jᵀr of one specimen, or the sum over several.
struct Normal {
  MatrixXd matrix;
  VectorXd vector;

  void add(const Normal& other, double times) {
    matrix += times * other.matrix;
    vector += times * other.vector;
  }
};

std::vector<Normal> normals_of(const FitProblem& problem, const Answer& answer,
                               const Landmarks& widen) {
  std::vector<Normal> normals;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const Index row = first_row(f);
    const MatrixXd rows = answer.slopes.jacobian.middleRows<landmark_count>(row);
    const VectorXd residuals = answer.best.residuals.segment<landmark_count>(row).array() * widen;
    normals.push_back({rows.transpose() * rows, rows.transpose() * residuals});
  }
  return normals;
}

// What a draw's residuals lack: the fit took it from them, landmark by landmark.
Landmarks widening(const FitProblem& problem, const Answer& answer) {
  const Landmarks told = residuals_told(problem, answer.best);
  const Landmarks freedom =
      (told - parameters_spent(problem, answer.best, answer.asked.jacobian)).max(1.0);
  return (told / freedom).max(1.0).sqrt();
}

Normal sum_of(const std::vector<Normal>& normals) {
  Normal all{0.0 * normals.front().matrix, 0.0 * normals.front().vector};
  for (const Normal& one : normals) all.add(one, 1.0);
  return all;
}

// −(JᵀJ)⁻¹ Jᵀr; NaN where the specimens do not determine it.
VectorXd step_of(const Normal& normal) {
  // Scaled to a diagonal of ones, so that one limit tells what is singular, whatever the units.
  const VectorXd scale = normal.matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * normal.matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  if (!(eigen.eigenvalues().minCoeff() > 1e-6))
    return VectorXd::Constant(normal.vector.size(), std::numeric_limits<double>::quiet_NaN());
  return -(scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * normal.vector));
}

// The specimen taken in a turn of a draw: a function of the arguments alone. The key is not that of
// the replicates' seeds.
std::size_t pick(std::uint64_t seed, int draw, std::size_t turn, std::size_t count) {
  const r123::Philox2x64::ctr_type counter{{static_cast<std::uint64_t>(draw), turn}};
  return r123::Philox2x64()(counter, {{seed ^ 0x626f6f74ULL}})[0] % count;
}

void bootstrap(const std::vector<Normal>& normals, std::uint64_t seed, Resampling& result) {
  const std::size_t n = normals.size();
  if (n < fewest_specimens) {
    result.missing = fmt::format("{} {} too few to draw from, {} are the least",
                                 count(n, "specimen"), n == 1 ? "is" : "are", fewest_specimens);
    return;
  }
  const Normal all = sum_of(normals);
  std::vector<std::vector<double>> shifts(static_cast<std::size_t>(all.vector.size()));
  // Not quite 0: the answer is not quite where its slopes vanish.
  const VectorXd here = step_of(all);
  for (int draw = 0; draw < draws; ++draw) {
    Normal sum{0.0 * all.matrix, 0.0 * all.vector};
    for (std::size_t turn = 0; turn < n; ++turn) sum.add(normals[pick(seed, draw, turn, n)], 1.0);
    const VectorXd shift = step_of(sum) - here;
    // Draws that do not determine the unknowns tell no shift of them.
    if (!shift.allFinite()) continue;
    for (std::size_t k = 0; k < shifts.size(); ++k)
      shifts[k].push_back(shift[static_cast<Index>(k)]);
  }
  if (static_cast<double>(shifts.front().size()) < (1.0 - most_singular) * draws) {
    result.missing = "too many draws of specimens do not determine it";
    return;
  }
  result.lower.resize(all.vector.size());
  result.upper = result.lower;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    std::ranges::sort(shifts[k]);
    const auto quantile = [&](double part) {
      return gsl_stats_quantile_from_sorted_data(shifts[k].data(), 1, shifts[k].size(), part);
    };
    result.lower[static_cast<Index>(k)] = quantile(0.025);
    result.upper[static_cast<Index>(k)] = quantile(0.975);
  }
}

// Active unknowns but those that a specimen has to itself (calibrate.level).
std::vector<Index> unknowns_of_others(const FitProblem& problem, const Answer& answer,
                                      std::size_t specimen) {
  std::vector<Index> others;
  for (std::size_t k = 0; k < answer.active.size(); ++k) {
    const Unknown& unknown = problem.unknown(answer.active[k]);
    if (unknown.level != Level::specimen || unknown.specimens.front() != specimen)
      others.push_back(static_cast<Index>(k));
  }
  return others;
}

}  // namespace

Resampling resample(const FitProblem& problem, const Answer& answer) {
  const auto normals = normals_of(problem, answer, Landmarks::Ones());
  const Normal all = sum_of(normals);

  Resampling result;
  const VectorXd here = step_of(all);
  result.left_out.setConstant(static_cast<Index>(normals.size()), all.vector.size(),
                              std::numeric_limits<double>::quiet_NaN());
  for (std::size_t f = 0; f < normals.size(); ++f) {
    Normal rest = all;
    rest.add(normals[f], -1.0);
    const auto k = unknowns_of_others(problem, answer, problem.fitted[f]);
    if (k.empty()) continue;
    const VectorXd step = step_of({rest.matrix(k, k), rest.vector(k)});
    result.left_out(static_cast<Index>(f), k) = (step - here(k)).transpose();
  }
  bootstrap(normals_of(problem, answer, widening(problem, answer)), problem.study.calibrate.seed,
            result);
  return result;
}

}  // namespace havers::calib
