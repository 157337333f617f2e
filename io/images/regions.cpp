// What is bone is decided on a small copy (I2, I3), where noise averages out and all images cost
// the same. Only samples of the image itself are needed for that, and its pixels for the outline
// (I4).
#include "io/images/regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "io/images/bars.hpp"
#include "io/images/masks.hpp"
#include "io/images/two_levels.hpp"

namespace havers::images {
namespace {

// A small, quiet copy with levels from 0 to 1.
cv::Mat small_copy(const cv::Mat& grey) {
  cv::Mat copy = averaged(grey, reduction(grey.size()), cv::BORDER_REPLICATE);
  cv::medianBlur(copy, copy, 5);
  cv::normalize(copy, copy, 0.0, 1.0, cv::NORM_MINMAX);
  return copy;
}

// Share of the image's frame that is set.
double share_of_frame(const cv::Mat& mask) {
  const int last_row = mask.rows - 1, last_column = mask.cols - 1;
  const int set = cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(last_row)) +
                  cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(last_column));
  return static_cast<double>(set) / (2.0 * (mask.rows + mask.cols));
}

// Whether a level has a connected part too large for a pore: a tenth of the image, holes filled, or
// of its frame.
bool is_a_region(const cv::Mat& level) {
  for (const Contour& contour : outer_contours(level)) {
    if (enclosed_area(contour) > 0.1 * static_cast<double>(level.total())) return true;
    cv::Mat part = cv::Mat::zeros(level.size(), CV_8U);
    fill(part, contour, 255);
    if (share_of_frame(part & level) > 0.1) return true;
  }
  return false;
}

// Whether a level is little else than one part, as a small bone is in a large image. What is dark
// in bright surroundings may be a pore: it must be a bar.
bool is_a_small_bone(const cv::Mat& level, bool dark) {
  double all = 0.0, largest = 0.0;
  Contour part;
  for (const Contour& contour : outer_contours(level)) {
    const double area = enclosed_area(contour);
    all += area;
    if (area > largest) largest = area, part = contour;
  }
  const double share = largest / static_cast<double>(level.total());
  return largest > 0.8 * all && (dark ? share > 0.03 && is_a_machined_bar(part) : share > 0.01);
}

// Parts of at least a tenth of the largest: text and scale bars are not.
std::vector<Blob> large_parts(const cv::Mat& mask) {
  std::vector<Blob> parts = blobs_of(mask);
  double largest = 0.0;
  for (const Blob& part : parts) largest = std::max(largest, enclosed_area(part.border));
  std::erase_if(parts,
                [&](const Blob& part) { return enclosed_area(part.border) < 0.1 * largest; });
  return parts;
}

// The same, holes filled.
cv::Mat main_parts(const cv::Mat& mask) {
  cv::Mat parts = cv::Mat::zeros(mask.size(), CV_8U);
  for (const Blob& part : large_parts(mask)) fill(parts, part.border, 255);
  return parts;
}

// What a thin wall keeps from the outside is lost on the small copy, but not from the convex hull.
cv::Mat hulls_of(const std::vector<Contour>& parts, cv::Size size) {
  cv::Mat hulls = cv::Mat::zeros(size, CV_8U);
  for (const Contour& border : parts) {
    Contour corners;
    cv::convexHull(border, corners);
    cv::fillConvexPoly(hulls, corners, 255);
  }
  return hulls;
}

// A bar's corner that pores nearly cut off is lost from its hull too, but not from its rectangle.
cv::Mat search_area(const cv::Mat& parts) {
  cv::Mat area = hulls_of(outer_contours(parts), parts.size());
  for (const Contour& hull : outer_contours(area)) {
    const cv::RotatedRect rectangle = cv::minAreaRect(hull);
    if (cv::contourArea(hull) < 0.88 * static_cast<double>(rectangle.size.area())) continue;
    std::array<cv::Point2f, 4> exact;
    rectangle.points(exact.data());
    const Contour corners(exact.begin(), exact.end());
    cv::fillConvexPoly(area, corners, 255);
  }
  return dilated(area, 5);
}

// Pores are the minority: the grey levels have a tail to their side of the smooth surface.
// Skewness, negative where the tail is dark.
double tail(const cv::Mat& grey, const cv::Mat& mask) {
  const std::vector<Sample> samples = sample(grey, mask, 20000);
  const std::vector<float> level = values_at(fit_surface(samples, grey.size(), 2), samples);
  double second = 0.0, third = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    second += std::pow(samples[i].value - level[i], 2);
    third += std::pow(samples[i].value - level[i], 3);
  }
  const auto n = static_cast<double>(samples.size());
  return second > 0.0 ? third / n / std::pow(second / n, 1.5) : 0.0;
}

// Each cell as `factor` × `factor` pixels; what is beyond `size` is cut off.
cv::Mat enlarged(const cv::Mat& cells, int factor, cv::Size size) {
  cv::Mat full(size, CV_8U);
  for (int y = 0; y < size.height; ++y) {
    if (y % factor != 0) {
      full.row(y - 1).copyTo(full.row(y));
      continue;
    }
    const auto* cell = cells.ptr<std::uint8_t>(y / factor);
    auto* row = full.ptr<std::uint8_t>(y);
    for (int x = 0; x < size.width; ++x) row[x] = cell[x / factor];
  }
  return full;
}

bool are_dark(io::Pores pores, bool found) {
  return pores == io::Pores::found ? found : pores == io::Pores::dark;
}

Regions all_of(const cv::Mat& grey, const cv::Mat& mask, io::Pores pores) {
  Regions regions;
  regions.box = cv::boundingRect(mask);
  regions.bone = mask(regions.box);
  regions.dark_pores = are_dark(pores, pores == io::Pores::found && tail(grey, mask) <= 0.0);
  return regions;
}

// (I5) Pores that the surface cuts are notches: what the convex hull adds to the outline, in pieces
// with a mouth much narrower than they are wide. On a machined bar, straight by itself, every notch
// that is not shallow is one.
bool is_a_cut_pore(const Blob& notch, const cv::Mat& hull, bool machined) {
  const cv::Rect box = cv::boundingRect(notch.border);
  const cv::Rect around = (box + cv::Size(2, 2) - cv::Point(1, 1)) & cv::Rect({}, hull.size());
  cv::Mat alone = cv::Mat::zeros(around.size(), CV_8U);
  cv::drawContours(alone, std::vector<Contour>{notch.border}, 0, 255, cv::FILLED, cv::LINE_8,
                   cv::noArray(), 0, -around.tl());
  const double mouth = cv::countNonZero(dilated(alone, 3) & ~hull(around));
  return notch.area > (machined ? 0.15 : 2.0) * mouth * mouth;
}

void fill_notches(const std::vector<Contour>& outlines, bool machined, cv::Mat& bone) {
  const cv::Mat hull = hulls_of(outlines, bone.size());
  cv::Mat notches = hull.clone(), pores = cv::Mat::zeros(bone.size(), CV_8U);
  cv::drawContours(notches, outlines, -1, 0, cv::FILLED);
  cv::morphologyEx(notches, notches, cv::MORPH_OPEN, cv::Mat::ones(5, 5, CV_8U));
  if (cv::countNonZero(notches) == 0) return;
  const double most = 0.1 * cv::countNonZero(bone);
  for (const Blob& notch : blobs_of(notches))
    if (notch.area <= most && is_a_cut_pore(notch, hull, machined)) fill(pores, notch.border, 255);
  // What the opening took off them is theirs, and where it is enclosed no marrow, which is larger.
  bone |= dilated(pores, 3) & hull;
  for (const Blob& part : blobs_of(bone))
    for (const Contour& hole : part.holes)
      if (enclosed_area(hole) <= most) fill(bone, hole, 255);
}

// The brighter one of two regions; none where bone fills the image. A level that is no region is
// that of pores: the rest is looked at again.
cv::Mat brighter_region(const cv::Mat& copy) {
  cv::Mat mask(copy.size(), CV_8U, cv::Scalar(255));
  for (int look = 0; look < 2; ++look) {
    const TwoLevels levels = split_levels(copy, mask);
    if (!is_a_step(levels, copy, mask)) break;
    const cv::Mat dark = ~levels.bright;
    const bool bright_region =
        is_a_region(levels.bright) || (look == 0 && is_a_small_bone(levels.bright, false));
    const bool dark_region = is_a_region(dark) || (look == 0 && is_a_small_bone(dark, true));
    const double step = cv::mean(copy, levels.bright & mask)[0] - cv::mean(copy, dark & mask)[0];
    if (look == 1 && step < 0.1) break;  // What is left of pores about them.
    if (bright_region && dark_region) return levels.bright;
    mask &= ~dilated(bright_region ? dark : levels.bright, 5);
  }
  return {};
}

// The masks of a bone that is one level of the small copy.
Regions around(const cv::Mat& level, cv::Size size) {
  const cv::Mat parts = main_parts(level), bone = parts & level;
  const cv::Mat core = eroded(bone, 3), search = search_area(parts);
  const cv::Mat background = dilated(bone, 9) & ~dilated(bone, 3) & ~parts;

  const int factor = reduction(size);
  const cv::Rect near = cv::boundingRect(search | background);
  const cv::Rect large(near.tl() * factor, near.size() * factor);
  Regions regions{.outlined = true};
  regions.box = large & cv::Rect({}, size);
  const cv::Mat& sure = cv::countNonZero(core) > 0 ? core : bone;
  regions.bone = enlarged(sure(near), factor, regions.box.size());
  regions.search = enlarged(search(near), factor, regions.box.size());
  regions.background = enlarged(background(near), factor, regions.box.size());
  return regions;
}

// Share of a region that differs from it to one side by half the step between the levels, holes of
// the small copy included; where noise does, it does to both sides.
double share_of_pores(const cv::Mat& grey, const cv::Mat& level, double step) {
  const cv::Mat inside = eroded(main_parts(level), 3);
  const std::vector<Sample> samples =
      sample(grey, enlarged(inside, reduction(grey.size()), grey.size()), 20000);
  const std::vector<float> surface = values_at(fit_majority(samples, grey.size()), samples);
  double net = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double difference = samples[i].value - surface[i];
    if (std::abs(difference) > 0.5 * step) net += difference > 0.0 ? 1.0 : -1.0;
  }
  return samples.empty() ? 0.0 : std::abs(net) / static_cast<double>(samples.size());
}

// A caption is drawn in one grey level, resin is photographed.
bool may_be_a_caption(const cv::Mat& grey, const cv::Mat& level) {
  if (3 * cv::countNonZero(level) > static_cast<int>(level.total())) return false;
  std::vector<float> values;
  for (const Sample& s : sample(grey, enlarged(level, reduction(grey.size()), grey.size()), 5000))
    values.push_back(s.value);
  return quantile(values, 0.3) == quantile(values, 0.7);
}

// (I3) Of two regions the bone is the one that has less of the image's frame. Where both reach it,
// as in a section cut by the image's edge, it is the one that has the pores; `either`: none has
// plainly more.
bool bright_is_bone(const cv::Mat& grey, const cv::Mat& bright, bool& either) {
  const cv::Mat dark = ~bright;
  const double by_bright = share_of_frame(bright), by_dark = share_of_frame(dark);
  if (std::min(by_bright, by_dark) < 0.1) return by_bright < by_dark;
  const cv::Mat cells = averaged(grey, reduction(grey.size()), cv::BORDER_REPLICATE);
  const double step = cv::mean(cells, bright)[0] - cv::mean(cells, dark)[0];
  const double in_bright = share_of_pores(grey, bright, step);
  const double in_dark = share_of_pores(grey, dark, step);
  either = std::max(in_bright, in_dark) < 3.0 * std::min(in_bright, in_dark) + 0.001 ||
           may_be_a_caption(grey, bright) || may_be_a_caption(grey, dark);
  return either ? by_bright < by_dark : in_bright > in_dark;
}

}  // namespace

Regions divide(const cv::Mat& grey, io::Pores pores) {
  const cv::Mat bright = brighter_region(small_copy(grey));
  if (bright.empty()) return all_of(grey, cv::Mat(grey.size(), CV_8U, cv::Scalar(255)), pores);

  const cv::Mat dark = ~bright;
  bool either = false, bright_bone = bright_is_bone(grey, bright, either);
  Regions regions = around(bright_bone ? bright : dark, grey.size());
  // Unless pores are said to be where neither background nor a tail of the bone's grey levels is.
  const bool dark_pores = are_dark(pores, bright_bone);
  if (dark_pores != bright_bone) {
    const double skewness = tail(grey(regions.box), regions.bone);
    if ((dark_pores ? -skewness : skewness) < 0.3) {
      bright_bone = !bright_bone;
      regions = around(bright_bone ? bright : dark, grey.size());
    }
  }
  regions.dark_pores = bright_bone;
  regions.either_is_bone = either;
  return regions;
}

Regions divide(const cv::Mat& grey, const cv::Mat& mask, io::Pores pores) {
  return all_of(grey, mask, pores);
}

// (I4) A hole larger than a tenth of what the outline encloses is marrow; smaller ones are pores.
cv::Mat outline(const cv::Mat& solid) {
  cv::Mat bone = cv::Mat::zeros(solid.size(), CV_8U);
  std::vector<Contour> outlines, holes;
  for (Blob& part : large_parts(solid)) {
    outlines.push_back(std::move(part.border));
    holes.insert(holes.end(), part.holes.begin(), part.holes.end());
  }
  if (outlines.empty()) return {};
  cv::drawContours(bone, outlines, -1, 255, cv::FILLED);
  const double enclosed = cv::countNonZero(bone);
  const bool machined = std::ranges::all_of(outlines, [](const Contour& border) {
    return is_a_machined_bar(border) && has_straight_sides(border);
  });
  std::erase_if(holes, [&](const Contour& hole) {
    return machined || enclosed_area(hole) <= 0.1 * enclosed;
  });
  cv::drawContours(bone, holes, -1, 0, cv::FILLED);
  cv::drawContours(bone, holes, -1, 255, 1);  // their borders are bone
  fill_notches(outlines, machined, bone);
  return bone;
}

}  // namespace havers::images
