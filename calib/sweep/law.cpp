#include "calib/sweep/law.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>

namespace havers::calib {
namespace {

// The values of the terms at a point, and 1 for the constant. Precondition: the terms are keys that
// the sweep varies.
std::vector<double> row_of(const LawRequest& request, const SweepPlan& plan,
                           const SweepPoint& point) {
  std::vector<double> row;
  for (const std::string& term : request.terms) row.push_back(point.numbers.at(plan.column(term)));
  row.push_back(1.0);
  return row;
}

// The design matrix and the response: a row for each run that tells the response.
struct Rows {
  std::vector<double> x;  // row by row
  std::vector<double> y;
};

Rows rows_of(const Law& law, const SweepPlan& plan, const std::vector<SweepPoint>& points,
             const std::vector<SweepRun>& runs) {
  Rows rows;
  for (const std::size_t point : law.points)
    for (const double value : values_of(runs, point, law.request.response)) {
      std::ranges::copy(row_of(law.request, plan, points[point]), std::back_inserter(rows.x));
      rows.y.push_back(value);
    }
  return rows;
}

// (W1), by GSL's singular value decomposition with balanced columns. Returns the residual sum of
// squares.
double least_squares(Rows rows, Law& law) {
  const std::size_t n = rows.y.size(), k = law.request.terms.size() + 1;
  std::vector<double> covariance(k * k);
  law.coefficients.resize(k);
  const auto x = gsl_matrix_view_array(rows.x.data(), n, k);
  const auto y = gsl_vector_view_array(rows.y.data(), n);
  auto c = gsl_vector_view_array(law.coefficients.data(), k);
  auto of_c = gsl_matrix_view_array(covariance.data(), k, k);
  const std::unique_ptr<gsl_multifit_linear_workspace, decltype(&gsl_multifit_linear_free)> work(
      gsl_multifit_linear_alloc(n, k), gsl_multifit_linear_free);
  double squares = 0.0;
  std::size_t rank = 0;
  gsl_multifit_linear_tsvd(&x.matrix, &y.vector, 1e-10, &c.vector, &of_c.matrix, &squares, &rank,
                           work.get());
  // Terms that vary together leave a combination of their coefficients open.
  if (rank < k) law.status = LawStatus::terms_do_not_vary;
  for (std::size_t j = 0; j < k; ++j)
    law.standard_errors.push_back(std::sqrt(covariance[j * k + j]));
  return squares;
}

// (W2) `pure` is the sum of squares of the runs about their points' means, with `within` degrees of
// freedom; `lack` is that of the means about the law, for `levels` points.
void test_lack_of_fit(const SweepPlan& plan, const std::vector<SweepPoint>& points,
                      const std::vector<SweepRun>& runs, Law& law) {
  double pure = 0.0, lack = 0.0, within = 0.0, levels = 0.0;
  for (const std::size_t point : law.points) {
    const Statistics mean = statistics_of(values_of(runs, point, law.request.response));
    if (mean.n == 0) continue;
    const auto n = static_cast<double>(mean.n);
    const double deviation = mean.mean - law.value(points[point], plan);
    if (mean.n > 1) pure += (n - 1.0) * mean.sd * mean.sd;
    lack += n * deviation * deviation;
    within += n - 1.0;
    levels += 1.0;
  }
  const double freedom = levels - static_cast<double>(law.coefficients.size());
  // With no more points than coefficients, one run each, or no scatter the law cannot be tested.
  if (freedom < 1.0 || within < 1.0 || !(pure > 0.0)) return;
  law.lack_of_fit = (lack / freedom) / (pure / within);
  law.lack_of_fit_p = gsl_cdf_fdist_Q(law.lack_of_fit, freedom, within);
}

void fit(const SweepPlan& plan, const std::vector<SweepPoint>& points,
         const std::vector<SweepRun>& runs, Law& law) {
  const Rows rows = rows_of(law, plan, points, runs);
  law.runs = static_cast<long>(rows.y.size());
  if (unbroken_of(runs, law.points, law.request.response) > 0)
    law.status = LawStatus::unbroken_runs;
  const std::size_t k = law.request.terms.size() + 1;
  // A bound is no value; to leave it out would be to fit the weaker runs alone.
  if (law.status == LawStatus::unbroken_runs || rows.y.size() <= k) return;
  law.status = LawStatus::fitted;
  const double squares = least_squares(rows, law);
  const auto freedom = static_cast<double>(rows.y.size() - k);
  const Statistics all = statistics_of(rows.y);
  law.residual_sd = std::sqrt(squares / freedom);
  law.confidence_factor = gsl_cdf_tdist_Qinv(0.025, freedom);
  // Runs that are equal but for rounding leave nothing to explain, and no law to test.
  if (!(all.sd > 1e-9 * std::abs(all.mean))) return;
  law.explained = 1.0 - squares / (static_cast<double>(all.n - 1) * all.sd * all.sd);
  test_lack_of_fit(plan, points, runs, law);
}

}  // namespace

std::string explain(LawStatus status) {
  constexpr std::array sentences{"fitted", "there are not more runs than coefficients",
                                 "the terms do not vary enough to be told apart",
                                 "runs did not break: raise loading.max_strain"};
  return sentences.at(static_cast<std::size_t>(status));
}

double Law::value(const SweepPoint& point, const SweepPlan& plan) const {
  const std::vector<double> row = row_of(request, plan, point);
  return std::inner_product(row.begin(), row.end(), coefficients.begin(), 0.0);
}

bool tries_law(const LawRequest& request, const SweepPlan& plan,
               const std::vector<SweepPoint>& points, const PointGroup& group) {
  // Points with the same terms count as one.
  std::set<std::vector<double>> rows;
  for (const std::size_t point : group.points) rows.insert(row_of(request, plan, points[point]));
  const std::size_t coefficients = request.terms.size() + 1;
  if (rows.size() <= coefficients) return false;
  Eigen::MatrixXd x(rows.size(), coefficients);
  for (Eigen::Index i = 0; const std::vector<double>& row : rows)
    x.row(i++) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), x.cols());
  // Normalised, as terms may differ by many orders of magnitude: the threshold is relative.
  x.colwise().normalize();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
  return qr.setThreshold(1e-10).rank() == x.cols();
}

std::vector<Law> fit_laws(const LawRequest& request, const SweepPlan& plan,
                          const std::vector<SweepPoint>& points,
                          const std::vector<SweepRun>& runs) {
  std::vector<Law> laws;
  for (PointGroup& group : groups_of(points, plan, request.per)) {
    Law law;
    law.request = request;
    law.at = group.value;
    law.points = std::move(group.points);
    fit(plan, points, runs, law);
    laws.push_back(std::move(law));
  }
  return laws;
}

}  // namespace havers::calib
