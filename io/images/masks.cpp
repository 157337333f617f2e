// Areas and lengths come from borders, not from counted pixels: one walk around an object gives
// both.
#include "io/images/masks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace havers::images {
namespace {

// Sides of pixels along a border: one a straight step, two a diagonal one. A turn about a blob adds
// four, one about a hole takes four away.
double sides(const Contour& border) {
  double found = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const cv::Point step = border[(i + 1) % border.size()] - border[i];
    found += std::abs(step.x) + std::abs(step.y);
  }
  return found;
}

// Lattice points on a border, B of Pick's theorem. A single pixel is a polygon of no length: B is
// 0.
double steps(const Contour& border) {
  return border.size() == 1 ? 0.0 : static_cast<double>(border.size());
}

}  // namespace

cv::Mat eroded(const cv::Mat& mask, int side) {
  cv::Mat result;
  cv::erode(mask, result, cv::Mat::ones(side, side, CV_8U));
  return result;
}

cv::Mat dilated(const cv::Mat& mask, int side) {
  cv::Mat result;
  cv::dilate(mask, result, cv::Mat::ones(side, side, CV_8U));
  return result;
}

// Distances are exact: the error of a small distance mask would grow with a rim's width.
cv::Mat eroded_by(const cv::Mat& mask, int reach) {
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance > reach;
}

std::vector<Contour> outer_contours(const cv::Mat& mask) {
  std::vector<Contour> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  return contours;
}

int reduction(cv::Size size) {
  constexpr double side = 128.0;
  return static_cast<int>(std::ceil(std::sqrt(1.0 * size.width * size.height) / side));
}

cv::Mat averaged(const cv::Mat& image, int factor, cv::BorderTypes beyond) {
  const int right = (factor - image.cols % factor) % factor;
  const int below = (factor - image.rows % factor) % factor;
  cv::Mat whole = image, strip;
  if (right + below > 0) cv::copyMakeBorder(image, whole, 0, below, 0, right, beyond);
  cv::Mat cells(whole.size() / factor, CV_32F);
  for (int y = 0; y < cells.rows; ++y) {  // A whole number is no mean: noise would be a step.
    whole.rowRange(y * factor, (y + 1) * factor).convertTo(strip, CV_32F);
    cv::Mat row = cells.row(y);
    cv::resize(strip, row, row.size(), 0.0, 0.0, cv::INTER_AREA);
  }
  return cells;
}

double diameter_of(double area) {
  return 2.0 * std::sqrt(area / std::numbers::pi);
}

// Pick's theorem: a polygon of lattice points holds A + B/2 + 1 of them.
double enclosed_area(const Contour& border) {
  return cv::contourArea(border) + 0.5 * steps(border) + 1.0;
}

double Blob::perimeter() const {
  return std::numbers::pi / 4.0 * edges;
}

std::vector<Blob> blobs_of(const cv::Mat& mask) {
  std::vector<Contour> contours;
  std::vector<cv::Vec4i> family;
  cv::findContours(mask, contours, family, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  std::vector<Blob> blobs;
  // `family` holds for each border: the next one on its level, the previous one, the first hole,
  // the border around it.
  for (int i = contours.empty() ? -1 : 0; i >= 0; i = family[static_cast<std::size_t>(i)][0]) {
    const auto outer = static_cast<std::size_t>(i);
    Blob blob{.area = enclosed_area(contours[outer]), .edges = sides(contours[outer]) + 4.0};
    for (int hole = family[outer][2]; hole >= 0; hole = family[static_cast<std::size_t>(hole)][0]) {
      Contour& inner = contours[static_cast<std::size_t>(hole)];
      blob.area -= cv::contourArea(inner) - 0.5 * steps(inner) + 1.0;  // Pick again, inside only
      blob.edges += sides(inner) - 4.0;
      blob.holes.push_back(std::move(inner));
    }
    blob.border = std::move(contours[outer]);
    blobs.push_back(std::move(blob));
  }
  return blobs;
}

// The greatest width is twice the greatest distance from the border, found only where the mean
// width allows of a crack: a string of pores is as long, but not as narrow throughout.
double slenderness(const Blob& blob) {
  const cv::Size2f sides_of_box = cv::minAreaRect(blob.border).size;
  const double length = 1.0 + std::max(sides_of_box.width, sides_of_box.height);
  if (length * blob.perimeter() < 8.0 * blob.area) return 1.0;  // mean width 2A/P
  const cv::Rect box = cv::boundingRect(blob.border);
  // With a frame of unset pixels, so that distances to the outside exist everywhere.
  cv::Mat alone = cv::Mat::zeros(box.size() + cv::Size(2, 2), CV_8U), distance;
  cv::drawContours(alone, std::vector<Contour>{blob.border}, 0, 255, cv::FILLED, cv::LINE_8,
                   cv::noArray(), 0, cv::Point(1, 1) - box.tl());
  cv::distanceTransform(alone, distance, cv::DIST_L2, 3);
  double greatest = 0.0;
  cv::minMaxLoc(distance, nullptr, &greatest);
  // A distance leads to the middle of the first pixel outside and is half a pixel too long.
  return length / std::max(1.0, 2.0 * greatest - 1.0);
}

void fill(cv::Mat& mask, const Contour& border, int value) {
  cv::drawContours(mask, std::vector<Contour>{border}, 0, value, cv::FILLED);
}

}  // namespace havers::images
