// Polynomials by normal equations. Their entries are sums of products of uⁱ and vʲ, and v is the
// same all along a row: so powers of u are summed for each pixel, products made once for each row.
#include "io/images/surface.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "io/images/masks.hpp"

namespace havers::images {
namespace {

// Exponents of uⁱvʲ by ascending degree, so that a lower degree is a head of the list.
struct Monomial {
  std::size_t i = 0, j = 0;
};
constexpr std::array<Monomial, 15> monomials = [] {
  std::array<Monomial, 15> all{};
  for (std::size_t degree = 0, k = 0; degree <= 4; ++degree)
    for (std::size_t j = 0; j <= degree; ++j) all[k++] = {degree - j, j};
  return all;
}();

// Maps 0 to `extent` onto −1 to 1: with powers of pixels the equations would be ill-conditioned.
double scaled(double position, int extent) {
  return 2.0 * position / extent - 1.0;
}

struct Normal {
  std::size_t degree = 0;
  Eigen::MatrixXd products;
  Eigen::VectorXd right;
};

// Samples of one row. Products of monomials are monomials again: sums of powers are all it takes.
void add_row(std::span<const Sample> row, cv::Size size, Normal& normal) {
  std::array<double, 9> powers{}, v{1.0};  // Σ uⁱ, vʲ
  std::array<double, 5> values{};          // Σ uⁱ value
  for (const Sample& s : row) {
    const double u = scaled(s.x, size.width);
    double power = 1.0;
    for (std::size_t i = 0; i <= 2 * normal.degree; ++i, power *= u) {
      powers[i] += power;
      if (i <= normal.degree) values[i] += power * s.value;
    }
  }
  for (std::size_t j = 1; j < v.size(); ++j) v[j] = v[j - 1] * scaled(row.front().y, size.height);
  for (Eigen::Index k = 0; k < normal.right.size(); ++k) {
    const Monomial& a = monomials[static_cast<std::size_t>(k)];
    normal.right(k) += values[a.i] * v[a.j];
    for (Eigen::Index l = 0; l < normal.right.size(); ++l) {
      const Monomial& b = monomials[static_cast<std::size_t>(l)];
      normal.products(k, l) += powers[a.i + b.i] * v[a.j + b.j];
    }
  }
}

}  // namespace

SurfaceRow Surface::row(double y) const {
  const double v = scaled(y, size.height);
  std::array<double, 5> along{};
  std::size_t k = 0;
  for (std::size_t degree = 0; degree <= 4; ++degree) {
    double power = 1.0;
    for (std::size_t j = 0; j <= degree; ++j, power *= v)
      along[degree - j] += coefficients[k++] * power;
  }
  SurfaceRow row{.scale = 2.0F / static_cast<float>(size.width)};
  std::copy(along.begin(), along.end(), row.c.begin());
  return row;
}

void Surface::evaluate_row(double y, float* values) const {
  const SurfaceRow along = row(y);
  for (int x = 0; x < size.width; ++x) values[x] = along.at(static_cast<float>(x));
}

std::vector<float> values_at(const Surface& surface, const std::vector<Sample>& samples) {
  std::vector<float> values;
  values.reserve(samples.size());
  SurfaceRow along;
  float row = -1.0F;
  for (const Sample& s : samples) {
    if (s.y != row) along = surface.row(row = s.y);
    values.push_back(along.at(s.x));
  }
  return values;
}

Surface fit_surface(const std::vector<Sample>& samples, cv::Size size, int degree) {
  const auto terms = [&degree] { return (degree + 1) * (degree + 2) / 2; };
  // A quartic becomes a quadratic, and that a constant.
  while (degree > 0 && std::ssize(samples) / terms() < 10) degree -= 2;
  Surface surface{.size = size};
  if (samples.empty()) return surface;
  const Eigen::Index n = terms();
  Normal normal{static_cast<std::size_t>(degree), Eigen::MatrixXd::Zero(n, n),
                Eigen::VectorXd::Zero(n)};
  for (auto row = samples.begin(); row != samples.end();) {
    const auto end =
        std::find_if(row, samples.end(), [&](const Sample& s) { return s.y != row->y; });
    add_row({row, end}, size, normal);
    row = end;
  }
  // A thin ring leaves combinations undetermined: hold these near zero.
  normal.products.diagonal().tail(n - 1).array() += 1e-7 * static_cast<double>(samples.size());
  const Eigen::VectorXd solved = normal.products.ldlt().solve(normal.right);
  std::copy(solved.begin(), solved.end(), surface.coefficients.begin());
  return surface;
}

// Least squares, again and again without what lies far from the median of its residuals; the last
// time over all samples, before over as few as tell which these are.
Surface fit_majority(const std::vector<Sample>& samples, cv::Size size) {
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / 5000);
  std::vector<Sample> few;
  for (std::size_t i = 0; i < samples.size(); i += stride) few.push_back(samples[i]);
  Surface surface = fit_surface(few, size, 2);
  for (int round = 0; round < 6; ++round) {
    const std::vector<Sample>& used = round < 5 ? few : samples;
    std::vector<float> residual = values_at(surface, used);
    for (std::size_t i = 0; i < used.size(); ++i) residual[i] = used[i].value - residual[i];
    std::vector<float> deviation = residual;
    const auto middle = static_cast<float>(quantile(deviation, 0.5));
    for (std::size_t i = 0; i < used.size(); ++i) deviation[i] = std::abs(residual[i] - middle);
    std::vector<float> sorted = deviation;
    // 2.5 standard deviations, estimated by the median deviation, which outliers hardly change.
    const double reach = 2.5 * 1.4826 * quantile(sorted, 0.5);
    std::vector<Sample> kept;
    kept.reserve(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
      if (deviation[i] <= reach) kept.push_back(used[i]);
    // Quadratic until the minority is left out: a quadratic bends towards it less than a quartic.
    surface = fit_surface(kept, size, round < 3 ? 2 : 4);
  }
  return surface;
}

std::vector<Sample> sample(const cv::Mat& image, const cv::Mat& mask, int count) {
  const int area = cv::countNonZero(mask);
  const int stride = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(area) / count)));
  std::vector<Sample> samples;
  cv::Mat row;
  for (int y = stride / 2; y < image.rows; y += stride) {
    image.row(y).convertTo(row, CV_32F);
    const auto* values = row.ptr<float>();
    for_each_set(mask, y, [&](int x) {
      if (x % stride == stride / 2)
        samples.push_back({static_cast<float>(x), static_cast<float>(y), values[x]});
    });
  }
  return samples;
}

double quantile(std::vector<float>& values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace havers::images
