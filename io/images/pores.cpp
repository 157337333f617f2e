#include "io/images/pores.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "io/images/masks.hpp"
#include "io/images/thresholds.hpp"

namespace havers::images {
namespace {

double relative_noise(const Levels& levels) {
  const double in_the_middle = std::abs(levels.contrast(levels.bone.coefficients[0]));
  return levels.noise / std::max(in_the_middle, 1e-300);
}

// Smoothing σ divides white noise by 2√π σ. As much as brings it to a tenth of the contrast, where
// a false pore of four pixels is out of the question, and half a pixel from 0.07 on, where
// it begins to fray the pores' edges. [px]
const double noise_divisor = 2.0 * std::sqrt(std::numbers::pi);
double enough_smoothing(const Levels& levels) {
  const double noise = relative_noise(levels);
  return noise < 0.07 ? 0.0 : std::clamp(10.0 / noise_divisor * noise, 0.5, 3.0);
}

// Where bone lies in a depth image, and how far about. From the shallow side, where no pore is once
// the other side's are left out: up to a third of pores moves neither by more than a tenth of the
// spread.
struct BoneDepth {
  double middle = 0.0, spread = 0.0;
};
BoneDepth bone_depth(const Depth& depth, const cv::Mat& bone) {
  std::vector<float> values = sample_depths(depth, bone, 20000), away;
  for (const float value : values) away.push_back(std::abs(value));
  const double reach = 5.0 * 1.4826 * quantile(away, 0.5);
  std::erase_if(values, [&](float value) { return value < -reach; });
  const double upper = quantile(values, 0.30), lower = quantile(values, 0.05);
  const double spread =
      (upper - lower) / (1.645 - 0.524);  // Their places in a normal distribution.
  return {upper + 0.524 * spread, spread};
}

// Where pores are deepest, by erosion that leaves enough of them.
cv::Mat cores_of(const cv::Mat& pores) {
  for (const int side : {7, 5}) {
    cv::Mat cores = eroded(pores, side);
    if (cv::countNonZero(cores) >= 200) return cores;
  }
  cv::Mat cores = eroded(pores, 3);
  return cv::countNonZero(cores) > 0 ? cores : pores;
}

// The test for a second level: patches of three by three pixels, all five deviations deep, are no
// chance. Small pores show under little smoothing, strong noise needs more. The half-way depth
// between bone and such patches; infinite: one level.
double rough_threshold(Depth& depth, const cv::Mat& bone) {
  const double noise = depth.levels.noise;
  for (int round = 0; round < 2; ++round) {
    if (noise > 0.0 && round == 1)
      cv::GaussianBlur(depth.grey, depth.grey, {}, 2.0, 2.0, cv::BORDER_REPLICATE);
    const BoneDepth solid = bone_depth(depth, bone);
    const double least = solid.middle + std::max(5.0 * solid.spread, 0.01 * noise);
    const DepthCount seeds(depth, eroded(deeper(depth, least, bone), 3));
    if (seeds.all() > 0.0) return 0.5 * (solid.middle + seeds.sum() / seeds.all());
  }
  return std::numeric_limits<double>::infinity();
}

// The bone as far from pores as a fiftieth of it is, beyond the reach of their blur.
cv::Mat clean_bone(const cv::Mat& solid) {
  const int enough = cv::countNonZero(solid) / 50;
  cv::Mat clean;
  for (const int side : {13, 11, 9, 7}) {
    clean = eroded(solid, side);
    if (cv::countNonZero(clean) >= enough) break;
  }
  return clean;
}

// Sets the pores' level and refits that of the bone away from pores. Returns the pores' cores;
// empty: none.
cv::Mat find_pore_level(const cv::Mat& grey, const cv::Mat& bone, Levels& levels) {
  Depth depth{.levels = levels};
  depth.levels.offset = 1.0, depth.levels.slope = depth.levels.least = 0.0;
  // Within the bone, or background would be smoothed into it.
  smooth(grey, levels.noise > 0.0 ? 1.0 : 0.0, depth, bone);
  const double threshold = rough_threshold(depth, bone);
  if (std::isinf(threshold)) return {};
  const cv::Mat pores = deeper(depth, threshold, bone);
  if (cv::countNonZero(pores) == 0) return {};

  Levels found = levels;
  const std::vector<Sample> samples = sample(grey, clean_bone(bone - pores), 20000);
  // From fewer samples a quartic would be uncertain: the level of the coarse division stays.
  if (samples.size() >= 500) found.bone = fit_surface(samples, grey.size(), 4);
  cv::Mat cores = cores_of(pores);
  fit_contrast(grey, cores, found);
  const double contrast = found.contrast(found.bone.coefficients[0]);
  if (!(contrast > levels.noise)) return {};  // The deepest of many patches of noise, or no deeper.
  levels = found;
  return cores;
}

// Depth that small pores' cores keep under blur: the pores' image, blurred alike, is read there.
double depth_left_in(const cv::Mat& cores, const cv::Mat& pores, double blur) {
  cv::Mat blurred;
  if (blur > 0.0)
    cv::GaussianBlur(pores, blurred, {}, blur, blur, cv::BORDER_REPLICATE);
  else
    blurred = pores;
  return std::max(0.5, cv::sum(blurred & cores)[0] / (255.0 * cv::countNonZero(cores)));
}

// (I7) Blur σ pulls the half-maximum contour of a pore inwards by σ²κ/2, κ its curvature: π σ² less
// area a pore, whatever its shape. Noise s lets the contour tremble by √(2π) σ s, which adds the
// share 2π s² of that again. A lower threshold gives the rest back. Sets the area by grey level.
double threshold_without_blur(const Depth& depth, const cv::Mat& cores, PoreMap& map) {
  const double smoothing = depth.sigma;
  const double noise = relative_noise(depth.levels) / std::max(1.0, noise_divisor * smoothing);
  cv::Mat surroundings = dilated(map.pores, 7);
  surroundings &= map.bone;
  const DepthCount about(depth, surroundings);
  // Across a straight edge of blur σ the depth falls from 0.7 to 0.3 within 1.0488 σ.
  const double blur = (about.above(0.3) - about.above(0.7)) / (1.0488 * map.perimeter);
  const double own_blur = std::sqrt(std::max(0.0, blur * blur - smoothing * smoothing));
  map.full_depth = 1.0 / depth_left_in(cores, map.pores, own_blur);
  map.area_by_grey = about.sum() / map.full_depth;
  const double share = 1.0 - 2.0 * std::numbers::pi * noise * noise;
  const auto pores = static_cast<double>(map.areas.size());
  const double lowering = share * std::sqrt(std::numbers::pi / 2.0) * blur * pores / map.perimeter;
  return std::max(0.3, 0.5 - lowering) * map.full_depth;
}

// Pores are the minority: the grey levels have a tail to their side of the bone's.
bool tail_is_dark(const cv::Mat& grey, const cv::Mat& bone, const Levels& levels) {
  const std::vector<Sample> samples = sample(grey, bone, 20000);
  const std::vector<float> level = values_at(levels.bone, samples);
  double third = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    third += std::pow(samples[i].value - level[i], 3);
  return third < 0.0;
}

// In the rim, where bone fades into background, only what continues a pore from further inside is
// pore.
void cut(const cv::Mat& inner, const PoreOptions& options, PoreMap& map) {
  if (options.rim) map.pores &= dilated(map.pores & inner, 5);
  sort_objects(options.crack_slenderness, map);
}

// Contrast of pores over that of the background. Most of the cores tell: a few pores in darker bone
// that passes for pores too would raise the mean. `before`: the levels against the background, when
// such bone still drew that of bone down.
double relative_contrast(const cv::Mat& grey, const cv::Mat& cores, const Levels& levels,
                         const Levels& before) {
  const std::vector<Sample> samples = sample(grey, cores, 5000);
  const std::vector<float> bone = values_at(levels.bone, samples);
  std::vector<float> ratios = values_at(before.bone, samples);
  // A shade multiplies at the most; what is steeper comes of bone among the background.
  const bool of_a_shade = std::abs(before.slope) <= 1.2;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double contrast = of_a_shade ? before.contrast(ratios[i]) : before.usual;
    const double background = ratios[i] - before.sign * contrast;
    const double whole = std::max(std::abs(bone[i] - background), 1e-300);
    ratios[i] = static_cast<float>(std::abs(bone[i] - samples[i].value) / whole);
  }
  return quantile(ratios, 0.5);
}

// Bone that is plainly no bone, nor the blurred border of pores, but passes for bone: patches of
// three by three pixels.
double half_deep_area(const Depth& depth, const cv::Mat& inner, const PoreMap& map) {
  const BoneDepth solid = bone_depth(depth, inner);
  const double least = std::max(0.5 * map.threshold, solid.middle + 5.0 * solid.spread);
  cv::Mat taken = deeper(depth, map.threshold, map.bone);
  taken |= map.pores;
  const cv::Mat patches = deeper(depth, least, inner) & ~dilated(taken, 11);
  return cv::countNonZero(dilated(eroded(patches, 3), 3));
}

PoreMap pores_of_one_side(const cv::Mat& grey, const cv::Mat& bone, const PoreOptions& options,
                          Depth& depth) {
  PoreMap map{.bone = bone, .dark = depth.levels.sign > 0.0};
  const Levels before = depth.levels;
  // Blur reaches further in than noise does: a sharp eye would take it for a second level.
  const cv::Mat inner = options.rim ? eroded(bone, 5) : bone;
  if (depth.grey.depth() == CV_32F) depth.grey.release();  // Four bytes a pixel are made anew.
  const cv::Mat cores = find_pore_level(grey, options.rim ? eroded(inner, 5) : bone, depth.levels);
  smooth(grey, enough_smoothing(depth.levels), depth);
  if (cores.empty()) {
    map.pores = cv::Mat::zeros(bone.size(), CV_8U);
    return map;
  }
  const bool half_maximum = options.threshold == io::Threshold::half_maximum;
  double next = options.threshold == io::Threshold::otsu ? otsu_threshold(depth, bone) : 0.5;
  bool settled = false;
  // Thresholds and corrections take turns, as a correction depends on the number and the perimeter
  // of the pores and changes both. Other rules cut once; for them threshold_without_blur is called
  // only because it sets the area by grey level.
  for (int round = 0; round < 4; ++round) {
    map.threshold = next;
    map.pores = options.threshold == io::Threshold::sauvola ? below_sauvola(depth, bone)
                                                            : deeper(depth, next, bone);
    cut(inner, options, map);
    if (map.areas.empty() || settled) break;
    next = threshold_without_blur(depth, cores, map);
    const double change = std::abs(next - map.threshold);
    if (!half_maximum || change < 0.003) break;
    settled = change < 0.02;  // The next change would be less than a sixth of this one.
  }
  map.other_side =
      static_cast<double>(cv::countNonZero(shallower(depth, -0.5, inner))) / cv::countNonZero(bone);
  map.half_deep = half_deep_area(depth, inner, map);
  if (options.rim)
    map.contrast = map.full_depth * relative_contrast(grey, cores, depth.levels, before);
  return map;
}

}  // namespace

cv::Mat find_bone(const cv::Mat& grey, Regions& regions, Depth& depth) {
  cv::Mat bone = std::move(regions.bone);
  const cv::Mat background = std::move(regions.background), search = std::move(regions.search);
  if (!regions.outlined) return bone;
  fit_contrast(grey, background, depth.levels);
  if (!(depth.levels.contrast(depth.levels.bone.coefficients[0]) > 0.0)) return {};
  smooth(grey, enough_smoothing(depth.levels), depth);
  // Half way to the background (I4), inside the hull of the coarse bone and a little around it.
  return outline(shallower(depth, 0.5, search));
}

PoreMap find_pores(const cv::Mat& grey, const cv::Mat& bone, const PoreOptions& options,
                   Depth& depth) {
  const bool known = options.pores != io::Pores::found;
  const bool dark = known ? options.pores == io::Pores::dark
                          : tail_is_dark(grey, options.rim ? eroded(bone, 5) : bone, depth.levels);
  depth.levels.sign = dark ? 1.0 : -1.0;
  Depth turned{.levels = depth.levels};
  PoreMap map = pores_of_one_side(grey, bone, options, depth);
  if (known || !map.areas.empty()) return map;
  turned.levels.sign = -depth.levels.sign;
  PoreMap other = pores_of_one_side(grey, bone, options, turned);
  if (other.areas.empty()) return map;
  depth = std::move(turned);
  return other;
}

void sort_objects(double crack_slenderness, PoreMap& map) {
  map.areas.clear();
  map.perimeter = map.crack_area = 0.0;
  map.crack_count = map.specks = 0;
  map.cracks.release();
  for (const Blob& object : blobs_of(map.pores)) {
    const bool speck = object.area < smallest_pore;
    const bool crack =
        !speck && crack_slenderness > 0.0 && slenderness(object) >= crack_slenderness;
    if (!speck && !crack) {
      map.areas.push_back(object.area);
      map.perimeter += object.perimeter();
      continue;
    }
    map.specks += speck ? 1 : 0;
    map.crack_count += crack ? 1 : 0;
    map.crack_area += crack ? object.area : 0.0;
    if (crack && map.cracks.empty()) map.cracks = cv::Mat::zeros(map.pores.size(), CV_8U);
    if (crack) fill(map.cracks, object.border, 255);
    fill(map.pores, object.border, 0);
  }
  map.area = cv::countNonZero(map.pores);
}

}  // namespace havers::images
