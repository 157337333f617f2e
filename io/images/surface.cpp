#include "io/images/surface.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace havers::images {
namespace {

using Monomials = Eigen::Matrix<double, 15, 1>;

// u^i v^j by ascending degree, so that a lower degree is a head of the list.
Monomials monomials(double u, double v) {
  Monomials m;
  m(0) = 1.0;
  for (Eigen::Index degree = 1, k = 1; degree <= 4; ++degree) {
    for (Eigen::Index j = 0; j < degree; ++j) m(k + j) = u * m(k - degree + j);
    m(k + degree) = v * m(k - 1);
    k += degree + 1;
  }
  return m;
}

double scaled(double position, int extent) {
  return 2.0 * position / extent - 1.0;
}

}  // namespace

double Surface::at(double x, double y) const {
  const std::array<double, 5> c = row(y);
  const double u = scaled(x, size.width);
  return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4])));
}

std::array<double, 5> Surface::row(double y) const {
  const double v = scaled(y, size.height);
  std::array<double, 5> along{};
  std::size_t k = 0;
  for (std::size_t degree = 0; degree <= 4; ++degree) {
    double power = 1.0;
    for (std::size_t j = 0; j <= degree; ++j, power *= v)
      along[degree - j] += coefficients[k++] * power;
  }
  return along;
}

Surface fit_surface(const std::vector<Sample>& samples, cv::Size size, int degree) {
  const auto terms = [&degree] { return (degree + 1) * (degree + 2) / 2; };
  while (degree > 0 && std::ssize(samples) / terms() < 10) degree -= 2;
  const Eigen::Index n = terms();
  Eigen::Matrix<double, 15, 15> products = Eigen::Matrix<double, 15, 15>::Zero();
  Monomials right = Monomials::Zero();
  for (const Sample& s : samples) {
    const Monomials m = monomials(scaled(s.x, size.width), scaled(s.y, size.height));
    products.noalias() += m * m.transpose();
    right += s.value * m;
  }
  // A thin ring leaves combinations undetermined: hold these near zero.
  Surface surface{.size = size};
  if (samples.empty()) return surface;
  Eigen::MatrixXd normal = products.topLeftCorner(n, n);
  normal.diagonal().tail(n - 1).array() += 1e-7 * static_cast<double>(samples.size());
  const Eigen::VectorXd solved = normal.ldlt().solve(right.head(n));
  std::copy(solved.begin(), solved.end(), surface.coefficients.begin());
  return surface;
}

// Least squares, again and again without what lies far from the median of its residuals.
Surface fit_majority(const std::vector<Sample>& samples, cv::Size size) {
  Surface surface = fit_surface(samples, size, 2);
  std::vector<float> residual(samples.size()), deviation(samples.size());
  for (int round = 0; round < 6; ++round) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      residual[i] = samples[i].value - static_cast<float>(surface.at(samples[i].x, samples[i].y));
    deviation = residual;
    const double middle = quantile(deviation, 0.5);
    for (std::size_t i = 0; i < samples.size(); ++i)
      deviation[i] = std::abs(residual[i] - static_cast<float>(middle));
    std::vector<float> sorted = deviation;
    const double reach = 2.5 * 1.4826 * quantile(sorted, 0.5);
    std::vector<Sample> kept;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (deviation[i] <= reach) kept.push_back(samples[i]);
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
    const auto* wanted = mask.ptr<std::uint8_t>(y);
    for (int x = stride / 2; x < image.cols; x += stride)
      if (wanted[x] != 0)
        samples.push_back({static_cast<float>(x), static_cast<float>(y), values[x]});
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
