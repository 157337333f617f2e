#include "io/images/regions.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "io/images/grey_image.hpp"
#include "io/images/two_levels.hpp"

namespace havers::images {
namespace {

using Contour = std::vector<cv::Point>;

cv::Mat square(int side) {
  return cv::Mat::ones(side, side, CV_8U);
}

// A small, quiet copy with levels from 0 to 1.
cv::Mat small_copy(const cv::Mat& grey) {
  cv::Mat copy;
  cv::resize(grey, copy, fitted(grey.size(), 128), 0.0, 0.0, cv::INTER_AREA);
  copy.convertTo(copy, CV_32F);
  cv::medianBlur(copy, copy, 5);
  cv::normalize(copy, copy, 0.0, 1.0, cv::NORM_MINMAX);
  return copy;
}

std::vector<Contour> outer_contours(const cv::Mat& mask) {
  std::vector<Contour> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  return contours;
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
    cv::Mat part = cv::Mat::zeros(level.size(), CV_8U);
    cv::drawContours(part, std::vector<Contour>{contour}, 0, 255, cv::FILLED);
    if (cv::countNonZero(part) > 0.1 * static_cast<double>(level.total())) return true;
    if (share_of_frame(part & level) > 0.1) return true;
  }
  return false;
}

// The larger parts of a mask, holes filled.
cv::Mat main_parts(const cv::Mat& mask) {
  std::vector<Contour> contours = outer_contours(mask);
  std::vector<double> areas;
  areas.reserve(contours.size());
  for (const Contour& contour : contours) areas.push_back(cv::contourArea(contour));
  const double largest = areas.empty() ? 0.0 : *std::max_element(areas.begin(), areas.end());
  cv::Mat parts = cv::Mat::zeros(mask.size(), CV_8U);
  for (std::size_t i = 0; i < contours.size(); ++i)
    if (areas[i] >= 0.1 * largest)
      cv::drawContours(parts, contours, static_cast<int>(i), 255, cv::FILLED);
  return parts;
}

cv::Mat enlarged(const cv::Mat& mask, cv::Size size) {
  cv::Mat large;
  cv::resize(mask, large, size, 0.0, 0.0, cv::INTER_NEAREST);
  return large;
}

// Pores are the minority: the side of the smooth surface to which the grey levels have their tail.
bool tail_is_dark(const cv::Mat& grey, const cv::Mat& mask) {
  const std::vector<Sample> samples = sample(grey, mask, 20000);
  const Surface surface = fit_surface(samples, grey.size(), 2);
  double third = 0.0;
  for (const Sample& s : samples) third += std::pow(s.value - surface.at(s.x, s.y), 3);
  return third <= 0.0;
}

bool are_dark(io::Pores pores, bool found) {
  return pores == io::Pores::found ? found : pores == io::Pores::dark;
}

Regions all_of(const cv::Mat& grey, const cv::Mat& mask, io::Pores pores) {
  Regions regions;
  regions.bone = mask;
  regions.dark_pores = are_dark(pores, pores == io::Pores::found && tail_is_dark(grey, mask));
  return regions;
}

// (I4) A hole larger than a tenth of what the outline encloses is marrow; smaller ones are pores.
void cut_out_marrow(const cv::Mat& solid, cv::Mat& bone) {
  const double enclosed = cv::countNonZero(bone);
  std::vector<Contour> contours;
  std::vector<cv::Vec4i> family;
  cv::findContours(solid, contours, family, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (family[i][3] < 0) continue;  // not a hole
    if (cv::contourArea(contours[i]) > 0.1 * enclosed)
      cv::drawContours(bone, contours, static_cast<int>(i), 0, cv::FILLED);
  }
  bone |= solid;
}

bool is_a_machined_bar(const Contour& hull) {
  return cv::contourArea(hull) > 0.95 * static_cast<double>(cv::minAreaRect(hull).size.area());
}

// (I5) Pores that the surface cuts are notches: what the convex hull adds to the outline, in pieces
// with a mouth much narrower than they are wide. On a machined bar, straight by itself, every notch
// that is not shallow is one.
bool is_a_cut_pore(const cv::Mat& notch, const cv::Mat& hull, bool machined) {
  cv::Mat grown;
  cv::dilate(notch, grown, square(3));
  const double area = cv::countNonZero(notch), mouth = cv::countNonZero(grown & ~hull);
  return area > (machined ? 0.15 : 2.0) * mouth * mouth;
}

void fill_notches(const std::vector<Contour>& outlines, cv::Mat& bone) {
  bool machined = true;
  cv::Mat hull = cv::Mat::zeros(bone.size(), CV_8U), filled = hull.clone();
  for (const Contour& contour : outlines) {
    Contour corners;
    cv::convexHull(contour, corners);
    cv::fillConvexPoly(hull, corners, 255);
    machined = machined && is_a_machined_bar(corners);
  }
  cv::drawContours(filled, outlines, -1, 255, cv::FILLED);
  const cv::Mat added = hull & ~filled;
  cv::Mat notches, labels, stats, centroids;
  cv::morphologyEx(added, notches, cv::MORPH_OPEN, square(5));
  const int count = cv::connectedComponentsWithStats(notches, labels, stats, centroids, 8);
  const double most = 0.1 * cv::countNonZero(filled);
  const cv::Rect image(cv::Point(), bone.size());
  for (int i = 1; i < count; ++i) {
    if (stats.at<int>(i, cv::CC_STAT_AREA) > most) continue;
    const cv::Rect box(
        stats.at<int>(i, cv::CC_STAT_LEFT) - 1, stats.at<int>(i, cv::CC_STAT_TOP) - 1,
        stats.at<int>(i, cv::CC_STAT_WIDTH) + 2, stats.at<int>(i, cv::CC_STAT_HEIGHT) + 2);
    const cv::Rect part = box & image;
    const cv::Mat notch = labels(part) == i;
    if (is_a_cut_pore(notch, hull(part), machined)) bone(part).setTo(255, notch);
  }
}

}  // namespace

Regions divide(const cv::Mat& grey, io::Pores pores) {
  const cv::Mat everywhere(grey.size(), CV_8U, cv::Scalar(255));
  const cv::Mat copy = small_copy(grey);
  const TwoLevels levels = split_levels(copy);
  if (!is_a_step(levels, copy)) return all_of(grey, everywhere, pores);
  const cv::Mat dark = ~levels.bright;
  if (!is_a_region(levels.bright) || !is_a_region(dark)) return all_of(grey, everywhere, pores);

  // (I3) Of two regions the bone is the one that has less of the image's frame.
  const bool bright_bone = are_dark(pores, share_of_frame(levels.bright) < share_of_frame(dark));
  const cv::Mat parts = main_parts(bright_bone ? levels.bright : dark);
  const cv::Mat bone = parts & (bright_bone ? levels.bright : dark);
  cv::Mat core, search, near, around;
  cv::erode(bone, core, square(3));
  cv::dilate(parts, search, square(5));
  cv::dilate(bone, near, square(3));
  cv::dilate(bone, around, square(9));
  Regions regions;
  regions.outlined = true;
  regions.dark_pores = bright_bone;
  regions.bone = enlarged(cv::countNonZero(core) > 0 ? core : bone, grey.size());
  regions.search = enlarged(search, grey.size());
  regions.background = enlarged(around & ~near & ~parts, grey.size());
  return regions;
}

Regions divide(const cv::Mat& grey, const cv::Mat& mask, io::Pores pores) {
  return all_of(grey, mask, pores);
}

cv::Mat outline(const cv::Mat& solid) {
  cv::Mat bone = main_parts(solid);
  if (cv::countNonZero(bone) == 0) return {};
  const std::vector<Contour> outlines = outer_contours(bone);
  cut_out_marrow(solid & bone, bone);
  fill_notches(outlines, bone);
  return bone;
}

}  // namespace havers::images
