// Smooth surfaces over an image, for levels that shading bends. Private to io/images.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace havers::images {

/// A pixel and a value there.
struct Sample {
  float x = 0.0F, y = 0.0F, value = 0.0F;
};

/// A quartic in x.
struct SurfaceRow {
  float scale = 0.0F;
  std::array<float, 5> c{};  ///< Coefficients of u⁰…u⁴, u = scale x − 1.

  [[nodiscard]] float at(float x) const {
    const float u = scale * x - 1.0F;
    return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4])));
  }
};

/// Polynomial of degree ≤ 4 in x and y over an image of `size`.
struct Surface {
  cv::Size size;
  std::array<double, 15> coefficients{};

  [[nodiscard]] SurfaceRow row(double y) const;
  /// The values of row y, one a pixel.
  void evaluate_row(double y, float* values) const;
};

/// Values of the surface at samples, which come row by row.
std::vector<float> values_at(const Surface& surface, const std::vector<Sample>& samples);

/// Least squares over samples, which come row by row. Fewer samples than a degree needs: a lower
/// degree.
Surface fit_surface(const std::vector<Sample>& samples, cv::Size size, int degree);

/// The surface of the majority, where a minority (pores) lies to one side.
Surface fit_majority(const std::vector<Sample>& samples, cv::Size size);

/// About `count` pixels of a one-channel image where `mask` is set, on a square grid.
std::vector<Sample> sample(const cv::Mat& image, const cv::Mat& mask, int count);

/// Quantile of values (reordered), share from 0 to 1; NaN without any.
double quantile(std::vector<float>& values, double share);

}  // namespace havers::images
