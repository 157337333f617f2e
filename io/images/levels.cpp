// Grey levels of bone, background and pores (I6): B and the noise from pixels that the coarse
// division calls bone, the contrast C from pixels known to be pores or background.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "io/images/pores.hpp"

namespace havers::images {
namespace {

// Second difference in both directions: blind to levels and slopes, 6 times the noise [Immerkær].
double noise_at(const cv::Mat& grey, const cv::Mat& mask) {
  const cv::Matx33f kernel(1, -2, 1, -2, 4, -2, 1, -2, 1);
  // 64 rows are enough for a median; each is filtered with its two neighbours, as the kernel needs.
  const int strips = 64, height = std::min(3, grey.rows);
  std::vector<float> found;
  cv::Mat difference;
  for (int strip = 0; strip < strips; ++strip) {
    const int top = (grey.rows - height) * strip / strips;
    cv::filter2D(grey.rowRange(top, top + height), difference, CV_32F, kernel);
    const auto* values = difference.ptr<float>(height / 2);
    const auto* wanted = mask.ptr<std::uint8_t>(top + height / 2);
    for (int x = 0; x < grey.cols; ++x)
      if (wanted[x] != 0) found.push_back(std::abs(values[x]));
  }
  return found.empty() ? 0.0 : quantile(found, 0.5) / 0.6745 / 6.0;
}

// What a program has segmented before is told by its two values, however much of it is pore; where
// there is a background, if pores have its value.
std::optional<double> bone_of_two_values(const cv::Mat& grey, const std::vector<Sample>& samples,
                                         const Regions& regions) {
  if (samples.empty()) return std::nullopt;
  const auto ends = std::ranges::minmax(samples, {}, &Sample::value);
  const double low = ends.min.value, high = ends.max.value;
  const bool only_these = std::ranges::all_of(
      samples, [&](const Sample& s) { return s.value == low || s.value == high; });
  if (!only_these) return std::nullopt;
  const double pores = regions.dark_pores ? low : high;
  if (regions.outlined &&
      std::abs(cv::mean(grey, regions.background)[0] - pores) > 0.25 * (high - low))
    return std::nullopt;
  return regions.dark_pores ? high : low;
}

}  // namespace

Levels bone_levels(const cv::Mat& grey, const Regions& regions) {
  Levels levels;
  levels.sign = regions.dark_pores ? 1.0 : -1.0;
  const std::vector<Sample> samples = sample(grey, regions.bone, 20000);
  if (const auto bone = bone_of_two_values(grey, samples, regions))
    levels.bone = {.size = grey.size(), .coefficients = {*bone}};
  else
    levels.bone = fit_majority(samples, grey.size());
  levels.noise = noise_at(grey, regions.bone);
  return levels;
}

// Contrast as a linear function of the bone level holds for a shade that multiplies, for one that
// adds, and for a negative of either. The slope is taken only where the levels span enough to show
// it.
void fit_contrast(const cv::Mat& grey, const cv::Mat& pores, Levels& levels) {
  const std::vector<Sample> samples = sample(grey, pores, 20000);
  const std::vector<float> bones = values_at(levels.bone, samples);
  std::vector<float> depths;
  double n = 0.0, b = 0.0, d = 0.0, bb = 0.0, bd = 0.0, dd = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double bone = bones[i], depth = levels.sign * (bone - samples[i].value);
    depths.push_back(static_cast<float>(depth));
    n += 1.0, b += bone, d += depth, bb += bone * bone, bd += bone * depth, dd += depth * depth;
  }
  if (n == 0.0) return;
  b /= n, d /= n;
  const double spread = bb / n - b * b, common = bd / n - b * d, total = dd / n - d * d;
  const double slope = spread > 0.0 ? common / spread : 0.0;
  const double unexplained = std::max(0.0, total - slope * common);
  const double slope_error = std::sqrt(unexplained / std::max(spread * n, 1e-300));
  // The slope must exceed three of its standard errors, and must not use up the contrast within
  // three standard deviations of B.
  const bool determined = std::abs(slope) > 3.0 * slope_error &&
                          std::abs(slope) * 3.0 * std::sqrt(spread) < std::abs(d);
  levels.slope = determined ? slope : 0.0;
  levels.usual = quantile(depths, 0.5);
  levels.offset = d - levels.slope * b;
  levels.least = 1e-3 * d;  // or a depth might be infinite
}

}  // namespace havers::images
