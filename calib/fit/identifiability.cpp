// (F10) An unknown is informed by what its column of the Jacobian has beyond the columns of the
// others, against the replicates' noise and against its bounds. Unknowns that are not are taken
// away one at a time, as each of them changes what is left of the others.
#include "calib/fit/identifiability.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "calib/count.hpp"

namespace havers::calib {
namespace {

// A slope counts when it stands out of its replicates' noise by this many standard errors ...
constexpr double standard_errors = 3.0;
// ... and the 95 % interval it allows is no wider than half the bounds: a standard error of an
// eighth.
constexpr double part_of_bounds = 1.0 / 8.0;

/// Column k of the Jacobian, split into what the other columns explain and the rest.
struct Column {
  Eigen::VectorXd rest;            // of the column, not explained
  Eigen::VectorXd coefficients{};  // moving z_k by 1 does what moving the others by these does
  double noise = 0.0;              // expected |rest|² if it were only noise
};

// By least squares over `others`, indices of columns; where there are none, the rest is the column
// itself.
Column split(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& variance, Eigen::Index k,
             const std::vector<Eigen::Index>& others) {
  Column column{.rest = jacobian.col(k)};
  column.noise = variance.col(k).sum();
  if (others.empty()) return column;
  const Eigen::MatrixXd matrix = jacobian(Eigen::all, others);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
  qr.setThreshold(1e-10);  // others that do the same share what they explain
  qr.compute(matrix);
  column.coefficients = qr.solve(jacobian.col(k));
  column.rest -= matrix * column.coefficients;
  // What the others explain brings their noise with it.
  for (std::size_t j = 0; j < others.size(); ++j)
    column.noise += std::pow(column.coefficients[static_cast<Eigen::Index>(j)], 2) *
                    variance.col(others[j]).sum();
  return column;
}

bool seen(const Column& column) {
  return column.rest.squaredNorm() > standard_errors * standard_errors * column.noise;
}

// Bounds that a study narrows make no specimen tell less.
bool informs(const Unknown& unknown, const Column& column) {
  const ParameterInfo& info = *unknown.info;
  const double usual = to_search(info, info.upper) - to_search(info, info.lower);
  // Residuals have unit variance: 1/|rest| is the standard error.
  return seen(column) &&
         column.rest.norm() * part_of_bounds * std::max(usual, unknown.range()) >= 1.0;
}

// Half a sentence on an unknown that shows nothing by itself, with the largest change of a residual
// that it makes.
std::string no_effect(const FitProblem& problem, const Unknown& unknown, const Column& column) {
  const bool logarithmic = unknown.info->scale == Scale::logarithmic;
  const std::size_t n = problem.fitted.size();
  const std::string specimens =
      n == 1 ? "the fitted specimen" : fmt::format("the {}", count(n, "fitted specimen"));
  const Eigen::VectorXd& slope = column.rest;
  // `slope`: standard deviations of a residual for each unit of z.
  if (slope.cwiseAbs().maxCoeff() < 1e-3)
    return fmt::format("structurally unidentifiable: nothing that {} {} changes with it", specimens,
                       n == 1 ? "shows" : "show");
  const char* const change = logarithmic ? "doubling it" : "changing it by 0.1";
  const double most = slope.cwiseAbs().maxCoeff() * (logarithmic ? std::log(2.0) : 0.1);
  // A large effect that chance could have made is no small one.
  if (!seen(column) && most >= 1.0)
    return fmt::format(
        "practically unidentifiable: what {} does to {}, up to {:.2g} "
        "standard deviations, is lost in the chance of the replicates; more of them "
        "(calibrate.options.replicates) may tell it",
        change, specimens, most);
  return fmt::format(
      "practically unidentifiable: {} moves no modulus, strength or failure strain of {} "
      "by more than {:.2g} of its standard deviation",
      change, specimens, most);
}

// A combination in words: how the partner has to move to undo what the unknown does.
std::string combination(const Unknown& unknown, const Unknown& partner, double coefficient,
                        double position) {
  const std::string pair = fmt::format("{} and {}", partner.label, unknown.label);
  if (partner.info->scale != Scale::logarithmic)
    return fmt::format("only a combination of {} is determined", pair);
  if (unknown.info->name == "scatter") {
    // Of a uniform draw the weakest joints bear σ₁ (1 − d/2) (M8). Where strength follows them,
    // this is the change of its logarithm for each unit of d.
    const double law = -0.5 / (1.0 - 0.5 * position);
    if (std::abs(coefficient / law - 1.0) < 0.15)
      return fmt::format("only {} × (1 − {}/2) is determined", partner.label, unknown.label);
  }
  if (unknown.info->scale != Scale::logarithmic)
    return fmt::format("only {} × exp({:.2g} {}) is determined", partner.label, coefficient,
                       unknown.label);
  return fmt::format("only {} × {}^{:.2g} is determined", partner.label, unknown.label,
                     coefficient);
}

// Column k of the active unknowns, and why it is left out.
LeftUnknown left_unknown(const FitProblem& problem, const Point& at, const Active& active,
                         const Differences& slopes, Eigen::Index k) {
  const auto index_of = [&](Eigen::Index column) {
    return active[static_cast<std::size_t>(column)];
  };
  const auto unknown_of = [&](Eigen::Index column) -> const Unknown& {
    return problem.unknown(index_of(column));
  };
  const Unknown& unknown = unknown_of(k);
  const Eigen::VectorXd slope = slopes.jacobian.col(k);
  const Column alone = split(slopes.jacobian, slopes.variance, k, {});
  if (!informs(unknown, alone)) return {index_of(k), no_effect(problem, unknown, alone)};

  // It shows, but not beside the others: the one whose column is most like its own is named.
  Eigen::Index partner = -1;
  double likeness = 0.0;
  for (Eigen::Index j = 0; j < slopes.jacobian.cols(); ++j) {
    if (j == k) continue;
    const double cosine = std::abs(slope.dot(slopes.jacobian.col(j))) /
                          std::max(slopes.jacobian.col(j).norm(), 1e-300);
    if (cosine <= likeness) continue;
    likeness = cosine;
    partner = j;
  }
  if (partner < 0) return {index_of(k), no_effect(problem, unknown, alone)};
  const auto& other = slopes.jacobian.col(partner);
  // Columns that are parallel to rounding cannot be told apart by any accuracy of these tests.
  const bool parallel = likeness > (1.0 - 1e-9) * slope.norm();
  return {index_of(k),
          (parallel ? "structurally unidentifiable: " : "practically unidentifiable: ") +
              combination(unknown, unknown_of(partner), slope.dot(other) / other.squaredNorm(),
                          at[index_of(k)]),
          index_of(partner)};
}

void erase_column(Eigen::MatrixXd& matrix, Eigen::Index k) {
  const Eigen::Index right = matrix.cols() - k - 1;
  matrix.middleCols(k, right) = matrix.rightCols(right).eval();
  matrix.conservativeResize(Eigen::NoChange, matrix.cols() - 1);
}

// The last column that is not informed, by itself or beside the others; −1 if all are. Those that
// show nothing by themselves go first: as noise they would blur what the rest tells apart.
Eigen::Index last_uninformed(const FitProblem& problem, const Active& active,
                             const Differences& slopes) {
  const auto last = [&](bool beside_others) {
    for (Eigen::Index k = slopes.jacobian.cols() - 1; k >= 0; --k) {
      std::vector<Eigen::Index> others;
      for (Eigen::Index j = 0; beside_others && j < slopes.jacobian.cols(); ++j)
        if (j != k) others.push_back(j);
      const Unknown& unknown = problem.unknown(active[static_cast<std::size_t>(k)]);
      if (!informs(unknown, split(slopes.jacobian, slopes.variance, k, others))) return k;
    }
    return Eigen::Index{-1};
  };
  const Eigen::Index alone = last(false);
  return alone >= 0 ? alone : last(true);
}

}  // namespace

std::string LeftUnknown::reason() const {
  return because + (kept_where_found ? "; kept where the fit found it, for the study's value "
                                       "contradicts the specimens"
                                     : "");
}

std::vector<LeftUnknown> uninformed(const FitProblem& problem, const Point& at, Active active,
                                    const Differences& slopes) {
  Differences rest = slopes;
  std::vector<LeftUnknown> left;
  for (Eigen::Index k = 0; (k = last_uninformed(problem, active, rest)) >= 0;) {
    left.push_back(left_unknown(problem, at, active, rest, k));
    // The others are judged anew: with one unknown less, some may be informed.
    active.erase(active.begin() + k);
    erase_column(rest.jacobian, k);
    erase_column(rest.variance, k);
  }
  return left;
}

Active without(const Active& active, const std::vector<LeftUnknown>& left) {
  Active rest;
  for (const Eigen::Index k : active)
    if (std::ranges::find(left, k, &LeftUnknown::unknown) == left.end()) rest.push_back(k);
  return rest;
}

}  // namespace havers::calib
