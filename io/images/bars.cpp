// (I5) A sawn bar is recognised by its outline alone: by how well its hull fills a rectangle and by
// how straight its sides are.
#include "io/images/bars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace havers::images {

bool is_a_machined_bar(const Contour& border) {
  Contour hull;
  cv::convexHull(border, hull);
  return cv::contourArea(hull) > 0.95 * static_cast<double>(cv::minAreaRect(hull).size.area());
}

bool has_straight_sides(const Contour& border) {
  Contour hull;
  cv::convexHull(border, hull);
  const cv::RotatedRect rectangle = cv::minAreaRect(hull);
  const double longest = std::max(rectangle.size.width, rectangle.size.height);
  // A pixel of the outline is on a side if it lies no deeper below the hull than this. [px]
  const double near = std::max(2.0, 0.005 * longest);
  const double c = std::cos(rectangle.angle * CV_PI / 180.0);
  const double s = std::sin(rectangle.angle * CV_PI / 180.0);
  const cv::Point2d middle = rectangle.center;
  // Pixels of the outline on the sides at −u, +u, −v and +v.
  std::array<double, 4> on_side{};
  for (const cv::Point& at : border) {
    if (cv::pointPolygonTest(hull, at, true) > near) continue;
    // In the rectangle's own axes: u along its width, v along its height.
    const double u = c * (at.x - middle.x) + s * (at.y - middle.y);
    const double v = c * (at.y - middle.y) - s * (at.x - middle.x);
    const double to_u = 0.5 * rectangle.size.width - std::abs(u);
    const double to_v = 0.5 * rectangle.size.height - std::abs(v);
    const std::size_t side = to_u < to_v ? (u > 0.0 ? 1 : 0) : (v > 0.0 ? 3 : 2);
    on_side.at(side) += 1.0;
  }
  const double tilt = std::max(std::abs(c), std::abs(s));  // Steps of pixels along a tilted side.
  const double wide = 0.5 * tilt * rectangle.size.width, high = 0.5 * tilt * rectangle.size.height;
  return std::min(on_side[0], on_side[1]) > high && std::min(on_side[2], on_side[3]) > wide;
}

}  // namespace havers::images
