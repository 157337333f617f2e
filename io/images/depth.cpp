// (I6) No depth is computed to compare it with a threshold. Instead the grey levels that are as
// deep as the threshold are computed for every fourth row, and pixels are compared with these
// limits, as integers where the pixels are integers.
#include "io/images/depth.hpp"

#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <type_traits>

namespace havers::images {
namespace {

// B bends so little that as many rows share one of its rows.
constexpr int rows_at_once = 4;

void bone_row(const Levels& levels, int y, cv::Mat& row) {
  row.create(1, levels.bone.size.width, CV_32F);
  levels.bone.evaluate_row(y + 0.5 * (rows_at_once - 1), row.ptr<float>());
}

// Grey levels as deep as `threshold`, one a pixel of a row.
void limit_row(const Levels& levels, double threshold, int y, cv::Mat& row) {
  bone_row(levels, y, row);
  const auto offset = static_cast<float>(levels.offset), slope = static_cast<float>(levels.slope);
  const auto least = static_cast<float>(levels.least);
  const auto share = static_cast<float>(levels.sign * threshold);
  auto* limit = row.ptr<float>();
  for (int x = 0; x < row.cols; ++x) limit[x] -= share * std::max(offset + slope * limit[x], least);
}

// 255 in `within` on one side of the grey levels that are as deep as `threshold`. Limits may lie
// beyond the pixels' range.
template <class Pixel, class Limit>
cv::Mat beyond(const Depth& depth, double threshold, bool darker, const cv::Mat& within) {
  // A whole number is below a limit where it is below the next whole one.
  const double next = std::is_integral_v<Limit> ? (darker ? 0.5 : -0.5) : 0.0;
  cv::Mat found(within.size(), CV_8U), exact, limits;
  const int width = found.cols;  // Of its own, or the loop over a row is not vectorised.
  for (int y = 0; y < found.rows; ++y) {
    if (y % rows_at_once == 0) {
      limit_row(depth.levels, threshold, y, exact);
      exact.convertTo(limits, cv::DataType<Limit>::type, depth.unit, next);
    }
    const auto* grey = depth.grey.ptr<Pixel>(y);
    const auto* limit = limits.ptr<Limit>();
    const auto* wanted = within.ptr<std::uint8_t>(y);
    auto* out = found.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x) {
      const bool set = darker ? grey[x] < limit[x] : grey[x] > limit[x];
      out[x] = static_cast<std::uint8_t>((set ? 255 : 0) & wanted[x]);
    }
  }
  return found;
}

cv::Mat darker_or_brighter(const Depth& depth, double threshold, bool darker,
                           const cv::Mat& within) {
  switch (depth.grey.depth()) {
    case CV_8U:
      return beyond<std::uint8_t, std::int16_t>(depth, threshold, darker, within);
    case CV_16U:
      return beyond<std::uint16_t, std::int32_t>(depth, threshold, darker, within);
    // Smoothed bytes reach from 0 to 255 · 128: a limit that saturates at 16 bits is still beyond.
    case CV_16S:
      return beyond<std::int16_t, std::int16_t>(depth, threshold, darker, within);
    default:
      return beyond<float, float>(depth, threshold, darker, within);
  }
}

// The image, and B where `within` is not set.
cv::Mat bone_beyond(const cv::Mat& within, const cv::Mat& image, const Levels& levels) {
  cv::Mat filled = image.clone(), exact, bone, beyond_it;
  for (int y = 0; y < image.rows; ++y) {
    if (y % rows_at_once == 0) {
      bone_row(levels, y, exact);
      exact.convertTo(bone, image.type());
    }
    cv::bitwise_not(within.row(y), beyond_it);
    bone.copyTo(filled.row(y), beyond_it);
  }
  return filled;
}

}  // namespace

void smooth(const cv::Mat& image, double sigma, Depth& depth, const cv::Mat& within) {
  if (!depth.grey.empty() && depth.sigma == sigma) return;
  depth.sigma = sigma;
  depth.unit = 1.0;
  depth.grey = image;
  if (sigma == 0.0) return;
  const bool bytes = image.depth() == CV_8U;
  // Smoothed bytes are not whole numbers: with 128 steps a level they still fit into 16 bits.
  depth.unit = bytes ? 128.0 : 1.0;
  // The kernel reaches three standard deviations to each side.
  const cv::Mat kernel = cv::getGaussianKernel(cvRound(6.0 * sigma) | 1, sigma, CV_32F);
  cv::sepFilter2D(within.empty() ? image : bone_beyond(within, image, depth.levels), depth.grey,
                  bytes ? CV_16S : CV_32F, depth.unit * kernel, kernel, {-1, -1}, 0.0,
                  cv::BORDER_REPLICATE);
}

cv::Mat deeper(const Depth& depth, double threshold, const cv::Mat& within) {
  return darker_or_brighter(depth, threshold, depth.levels.sign > 0.0, within);
}

cv::Mat shallower(const Depth& depth, double threshold, const cv::Mat& within) {
  return darker_or_brighter(depth, threshold, depth.levels.sign < 0.0, within);
}

std::vector<float> sample_depths(const Depth& depth, const cv::Mat& mask, int count) {
  const std::vector<Sample> samples = sample(depth.grey, mask, count);
  std::vector<float> depths = values_at(depth.levels.bone, samples);
  for (std::size_t i = 0; i < samples.size(); ++i)
    depths[i] = static_cast<float>(depth.levels.depth(depths[i], samples[i].value / depth.unit));
  return depths;
}

}  // namespace havers::images
