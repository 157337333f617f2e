// Smooth surfaces over an image, for levels that shading bends. Private to io/images.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace havers::images {

/// A pixel and a value there. [px, px, grey levels]
struct Sample {
  float x = 0.0F, y = 0.0F, value = 0.0F;
};

/// A surface along one row: a quartic in x, in floats, as it is evaluated at every pixel.
struct SurfaceRow {
  float scale = 0.0F;        ///< 2 over the image's width. [1/px]
  std::array<float, 5> c{};  ///< Coefficients of u⁰…u⁴, u = scale x − 1.

  [[nodiscard]] float at(float x) const {
    const float u = scale * x - 1.0F;
    return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4])));
  }
};

/// Polynomial of degree ≤ 4 in x and y over an image of `size`. The coefficients are those of 1, u,
/// v, u², uv, v², …, of u and v from −1 to 1 over the image; the first is the value in its middle.
struct Surface {
  cv::Size size;
  std::array<double, 15> coefficients{};

  /// The surface along row y, which may lie between two rows.
  [[nodiscard]] SurfaceRow row(double y) const;
  /// The values of row y, one a pixel.
  void evaluate_row(double y, float* values) const;
};

/// Values of the surface at samples, which come row by row.
std::vector<float> values_at(const Surface& surface, const std::vector<Sample>& samples);

/// Least squares over samples, which come row by row. With fewer than ten samples a coefficient the
/// degree is reduced, by two at a time. Without samples the surface is zero.
Surface fit_surface(const std::vector<Sample>& samples, cv::Size size, int degree);

/// The surface of the majority, where a minority (pores) lies to one side; of degree 4 (I6).
Surface fit_majority(const std::vector<Sample>& samples, cv::Size size);

/// About `count` pixels of a one-channel image where `mask` is set, on a square grid.
std::vector<Sample> sample(const cv::Mat& image, const cv::Mat& mask, int count);

/// Quantile of values (reordered), share from 0 to 1; NaN without any. O(n) on average.
double quantile(std::vector<float>& values, double share);

}  // namespace havers::images
