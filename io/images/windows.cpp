// (I9) and (I10). For each row of windows, set pixels are counted column by column and summed from
// left to right; a window then costs O(1), and no integral image of the whole section is kept.
#include "io/images/windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace havers::images {
namespace {

constexpr int parts = 4;  // Along each side of the grid of blocks.

// The number of windows, and Σ q and Σ q² of their porosities q.
struct Sums {
  double n = 0.0, q = 0.0, qq = 0.0;
};
using Blocks = std::array<Sums, static_cast<std::size_t>(parts) * parts>;

// Which part of the 4 × 4 grid a pixel lies in.
std::size_t block_of(int x, int y, cv::Size size) {
  const int row = y * parts / size.height, column = x * parts / size.width;
  const int block = row * parts + column;
  return static_cast<std::size_t>(block);
}

// How many set pixels lie left of each column in the rows from y to y + height.
class SetToTheLeft {
 public:
  explicit SetToTheLeft(const cv::Mat& mask)
      : mask_(mask),
        rows_(static_cast<std::size_t>(mask.cols)),
        whole_(rows_.size() + 1),
        last_(rows_.size() + 1) {}

  void count(int y, double height) {
    std::fill(rows_.begin(), rows_.end(), std::uint16_t{0});
    const int whole = static_cast<int>(height);
    for (int row = y; row < y + whole; ++row) {
      const auto* set = mask_.ptr<std::uint8_t>(row);
      for (std::size_t x = 0; x < rows_.size(); ++x)
        rows_[x] = static_cast<std::uint16_t>(rows_[x] + (set[x] & 1U));
    }
    for (std::size_t x = 0; x < rows_.size(); ++x) whole_[x + 1] = whole_[x] + rows_[x];
    share_ = height - whole;
    if (share_ == 0.0) return;
    const auto* last = mask_.ptr<std::uint8_t>(y + whole);
    for (std::size_t x = 0; x < rows_.size(); ++x) last_[x + 1] = last_[x] + (last[x] & 1U);
  }
  // In the columns from x to x + width; the last one may be cut.
  [[nodiscard]] double between(int x, double width) const {
    const int end = x + static_cast<int>(width);
    const double part = width - static_cast<int>(width), all = left_of(end) - left_of(x);
    return part > 0.0 ? all + part * (left_of(end + 1) - left_of(end)) : all;
  }

 private:
  [[nodiscard]] double left_of(int column) const {
    const auto x = static_cast<std::size_t>(column);
    return whole_[x] + share_ * last_[x];
  }
  const cv::Mat& mask_;
  std::vector<std::uint16_t> rows_;   // Set pixels in each column.
  std::vector<std::uint32_t> whole_;  // Sums of them.
  std::vector<std::uint32_t> last_;   // The same of the last row, which may be cut.
  double share_ = 0.0;                // How much of that row counts.
};

// Adds the windows of one orientation to the sums of the blocks they start in.
void add_windows(const cv::Mat& bone, const cv::Mat& pores, cv::Size2d window, Blocks& blocks) {
  if (window.width > bone.cols || window.height > bone.rows) return;
  const cv::Size covered(static_cast<int>(std::ceil(window.width)),
                         static_cast<int>(std::ceil(window.height)));
  // Half a window apart: what lies between says nothing new.
  const int across = std::max(1, static_cast<int>(window.width / 2.0));
  const int down = std::max(1, static_cast<int>(window.height / 2.0));
  const double scale = 1.0 / window.area();
  SetToTheLeft bones(bone), holes(pores);
  for (int y = 0; y + covered.height <= bone.rows; y += down) {
    bones.count(y, covered.height);
    holes.count(y, window.height);
    for (int x = 0; x + covered.width <= bone.cols; x += across) {
      if (bones.between(x, covered.width) < covered.area()) continue;
      const double q = holes.between(x, window.width) * scale;
      Sums& sums = blocks[block_of(x, y, bone.size())];
      sums.n += 1.0, sums.q += q, sums.qq += q * q;
    }
  }
}

}  // namespace

WindowSpread window_spread(const cv::Mat& bone, const cv::Mat& pores, double length,
                           double height) {
  const cv::Rect box = cv::boundingRect(bone);
  Blocks blocks{};
  add_windows(bone(box), pores(box), {length, height}, blocks);
  add_windows(bone(box), pores(box), {height, length}, blocks);

  Sums all;
  for (const Sums& block : blocks) all.n += block.n, all.q += block.q, all.qq += block.qq;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  if (all.n == 0.0) return {unknown, unknown};
  const double mean = all.q / all.n;
  const double variance = std::max(0.0, all.qq / all.n - mean * mean);
  double squares = 0.0, used = 0.0;
  // `own` is a part's variance about the mean of all windows; its weight is the part's share of
  // them.
  for (const Sums& block : blocks) {
    if (block.n == 0.0) continue;
    const double own = (block.qq - 2.0 * mean * block.q) / block.n + mean * mean;
    squares += std::pow(block.n / all.n * (own - variance), 2);
    used += 1.0;
  }
  WindowSpread spread{.sd = std::sqrt(variance)};
  if (used > 1.0 && spread.sd > 0.0)
    // The error of the variance, divided by 2 SD, is that of the SD.
    spread.standard_error = std::sqrt(used / (used - 1.0) * squares) / (2.0 * spread.sd);
  return spread;
}

double porosity_standard_error(const cv::Mat& bone, const cv::Mat& pores) {
  const cv::Rect box = cv::boundingRect(bone);
  const double all = cv::countNonZero(bone), mean = cv::countNonZero(pores) / all;
  double squares = 0.0, used = 0.0;
  for (int part = 0; part < parts * parts; ++part) {
    const int i = part % parts, j = part / parts;
    const cv::Rect block(
        cv::Point(box.x + box.width * i / parts, box.y + box.height * j / parts),
        cv::Point(box.x + box.width * (i + 1) / parts, box.y + box.height * (j + 1) / parts));
    // w (p_i − p) of (I10), w the part's share of the bone.
    const double area = cv::countNonZero(bone(block));
    squares += std::pow((cv::countNonZero(pores(block)) - mean * area) / all, 2);
    used += area > 0.0 ? 1.0 : 0.0;
  }
  return used > 1.0 ? std::sqrt(used / (used - 1.0) * squares) : 0.0;
}

}  // namespace havers::images
