// The running bond as a grid of corners that neighbours share, turned and clipped. What the sides
// cut to a sliver is left out, and the grid is closed over it before all is clipped once more.
#include "sim/assembly/half_fibres.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace havers::sim {
namespace {

using Eigen::Vector2d;

constexpr double smallest_area = 1e-6;    // of a half fibre
constexpr double smallest_closed = 1e-8;  // of one whose neighbours fill a sliver's place
constexpr int most_passes = 5;            // over the grid; fewer where no sliver is left to close

// Columns and layers of half fibres that can meet the rectangle.
struct GridRange {
  int first_column, last_column, first_layer, last_layer;
};

GridRange grid_range(const AssemblyOptions& options) {
  const Eigen::Rotation2Dd to_fibres(-options.orientation);
  // The specimen's corners, seen from the fibres.
  Eigen::AlignedBox2d box;
  for (const double x : {0.0, options.width()})
    for (const double y : {0.0, options.height()}) box.extend(to_fibres * Vector2d(x, y));
  const Vector2d &low = box.min(), &high = box.max();
  const double half = 0.5 * options.fibre_length, height = options.fibre_height;
  const auto floor = [](double v) { return static_cast<int>(std::floor(v)); };
  return {floor(low.x() / half) - 1, floor(high.x() / half) + 1, floor(low.y() / height) - 1,
          floor(high.y() / height) + 1};
}

// The corners of the half fibres, turned by θ about the specimen's, and what of these lies in it.
class Grid {
 public:
  explicit Grid(const AssemblyOptions& options) : options_(options), range_(grid_range(options)) {
    const Eigen::Rotation2Dd to_specimen(options.orientation);
    for (int layer = range_.first_layer; layer <= range_.last_layer + 1; ++layer)
      for (int column = range_.first_column; column <= range_.last_column + 1; ++column)
        corners_.emplace_back(to_specimen * Vector2d(0.5 * column * options.fibre_length,
                                                     layer * options.fibre_height));
  }

  // Those of which something is left.
  [[nodiscard]] HalfFibres half_fibres() const {
    HalfFibres halves;
    // The order of the map is that of bodies and joints, whatever order they are found in.
    for (int layer = range_.first_layer; layer <= range_.last_layer; ++layer)
      for (int column = range_.first_column; column <= range_.last_column; ++column) {
        Polygon polygon = half_fibre(layer, column);
        if (!polygon.empty()) halves[{layer, column}].polygon = std::move(polygon);
      }
    return halves;
  }

  // Shifts the edge by which a sliver meets its neighbours through the sliver, so that they fill
  // its place: whatever is dropped, no stress is lost (M1). Of equal edges, as all slivers have at
  // 45 degrees, rounding does not choose. Whether it was worth a shift.
  bool close(int layer, int column, const Polygon& sliver) {
    int longest = -1;
    double length = 0.0;
    for (int edge = 0; edge < 4; ++edge)
      for (std::size_t i = 0; i < sliver.size(); ++i) {
        const double size = (sliver[(i + 1) % sliver.size()].position - sliver[i].position).norm();
        if (sliver[i].edge != outline[static_cast<std::size_t>(edge)] ||
            size <= length + geometric_tolerance(options_))
          continue;
        length = size;
        longest = edge;
      }
    if (longest < 0) return false;
    Vector2d &from = corners_[corner(layer, column, longest)],
             &to = corners_[corner(layer, column, (longest + 1) % 4)];
    // The outline runs anticlockwise: inside is to the left.
    const Vector2d inward = Vector2d(from.y() - to.y(), to.x() - from.x()).normalized();
    // How deep the sliver reaches is how far its edge is shifted.
    double depth = 0.0;
    for (const Vertex& vertex : sliver) depth = std::max(depth, inward.dot(vertex.position - from));
    from += depth * inward;
    to += depth * inward;
    return depth > geometric_tolerance(options_);
  }

 private:
  static constexpr std::array outline{EdgeOrigin::lower, EdgeOrigin::head, EdgeOrigin::upper,
                                      EdgeOrigin::tail};

  [[nodiscard]] Polygon half_fibre(int layer, int column) const {
    Polygon polygon;
    for (int i = 0; i < 4; ++i)
      polygon.push_back({corners_[corner(layer, column, i)], outline[static_cast<std::size_t>(i)]});
    return clip(std::move(polygon), options_.width(), options_.height(),
                geometric_tolerance(options_));
  }

  // The corner where edge i of a half fibre's outline starts.
  [[nodiscard]] std::size_t corner(int layer, int column, int i) const {
    const int row = range_.last_column - range_.first_column + 2;
    const int k = layer + (i >= 2 ? 1 : 0), m = column + (i == 1 || i == 2 ? 1 : 0);
    return static_cast<std::size_t>((k - range_.first_layer) * row + m - range_.first_column);
  }

  const AssemblyOptions& options_;
  GridRange range_;
  std::vector<Vector2d> corners_;  // [m]
};

}  // namespace

HalfFibres clipped_half_fibres(const AssemblyOptions& options, int& dropped) {
  Grid grid(options);
  const double whole = 0.5 * options.fibre_length * options.fibre_height;
  for (int pass = 1;; ++pass) {
    // A sliver that is closed has no area left in later passes: it is left out again, and counted
    // once.
    HalfFibres halves = grid.half_fibres();
    const double smallest = (pass == 1 ? smallest_area : smallest_closed) * whole;
    bool closed = false;
    for (auto half = halves.begin(); half != halves.end();) {
      const auto& [place, found] = *half;
      if (area(found.polygon) >= smallest) {
        ++half;
        continue;
      }
      if (pass == 1) ++dropped;
      closed = grid.close(place.first, place.second, found.polygon) || closed;
      half = halves.erase(half);
    }
    if (!closed || pass == most_passes) return halves;
  }
}

}  // namespace havers::sim
