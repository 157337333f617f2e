#include "sim/assembly/assembly.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/assembly/half_fibres.hpp"

namespace havers::sim {
namespace {

using Eigen::Vector2d;

constexpr double smallest_area = 1e-6;    // of a half fibre
constexpr double smallest_closed = 1e-8;  // of one whose neighbours fill a sliver's place

// Fibre frame (ξ along the fibre, η across) turned by θ about the corner.
struct FibreFrame {
  explicit FibreFrame(double angle) : axis(std::cos(angle), std::sin(angle)) {}
  [[nodiscard]] Vector2d to_specimen(double xi, double eta) const {
    return {xi * axis.x() - eta * axis.y(), xi * axis.y() + eta * axis.x()};
  }
  [[nodiscard]] Vector2d to_fibres(const Vector2d& p) const {
    return {p.x() * axis.x() + p.y() * axis.y(), p.y() * axis.x() - p.x() * axis.y()};
  }
  Vector2d axis;
};

// Columns and layers of half fibres that can meet the rectangle.
struct GridRange {
  int first_column, last_column, first_layer, last_layer;
};

GridRange grid_range(const AssemblyOptions& options, const FibreFrame& frame) {
  Vector2d low(INFINITY, INFINITY), high(-INFINITY, -INFINITY);
  for (const double x : {0.0, options.width()}) {
    for (const double y : {0.0, options.height()}) {
      const Vector2d p = frame.to_fibres({x, y});
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const double half = 0.5 * options.fibre_length, height = options.fibre_height;
  const auto floor = [](double v) { return static_cast<int>(std::floor(v)); };
  return {floor(low.x() / half) - 1, floor(high.x() / half) + 1, floor(low.y() / height) - 1,
          floor(high.y() / height) + 1};
}

// The corners of the half fibres, and what of these lies in the specimen.
class Grid {
 public:
  explicit Grid(const AssemblyOptions& options)
      : range(grid_range(options, FibreFrame(options.orientation))), options_(options) {
    const FibreFrame frame(options.orientation);
    for (int layer = range.first_layer; layer <= range.last_layer + 1; ++layer)
      for (int column = range.first_column; column <= range.last_column + 1; ++column)
        corners_.push_back(
            frame.to_specimen(0.5 * column * options.fibre_length, layer * options.fibre_height));
  }

  [[nodiscard]] Polygon half_fibre(int layer, int column) const {
    Polygon polygon;
    for (int i = 0; i < 4; ++i)
      polygon.push_back({corners_[corner(layer, column, i)], outline[static_cast<std::size_t>(i)]});
    return clip(std::move(polygon), options_.width(), options_.height(),
                geometric_tolerance(options_));
  }

  // Shifts the edge by which a sliver meets its neighbours through the sliver, so that they fill
  // its place: whatever is dropped, no stress is lost (M1). Whether it was worth a shift.
  bool close(int layer, int column, const Polygon& sliver) {
    int longest = -1;
    double length = 0.0;
    for (std::size_t i = 0; i < sliver.size(); ++i) {
      const double size = (sliver[(i + 1) % sliver.size()].position - sliver[i].position).norm();
      if (sliver[i].edge == EdgeOrigin::boundary || size <= length) continue;
      length = size;
      longest = static_cast<int>(std::find(outline.begin(), outline.end(), sliver[i].edge) -
                                 outline.begin());
    }
    if (longest < 0) return false;
    Vector2d &from = corners_[corner(layer, column, longest)],
             &to = corners_[corner(layer, column, (longest + 1) % 4)];
    const Vector2d inward = Vector2d(from.y() - to.y(), to.x() - from.x()).normalized();
    double depth = 0.0;
    for (const Vertex& vertex : sliver) depth = std::max(depth, inward.dot(vertex.position - from));
    from += depth * inward;
    to += depth * inward;
    return depth > geometric_tolerance(options_);
  }

  const GridRange range;

 private:
  static constexpr std::array outline{EdgeOrigin::lower, EdgeOrigin::head, EdgeOrigin::upper,
                                      EdgeOrigin::tail};

  // The corner where edge i of a half fibre's outline starts.
  [[nodiscard]] std::size_t corner(int layer, int column, int i) const {
    const int row = range.last_column - range.first_column + 2;
    const int k = layer + (i >= 2 ? 1 : 0), m = column + (i == 1 || i == 2 ? 1 : 0);
    return static_cast<std::size_t>((k - range.first_layer) * row + m - range.first_column);
  }

  const AssemblyOptions& options_;
  std::vector<Vector2d> corners_;  // [m]
};

HalfFibres clipped_half_fibres(const AssemblyOptions& options, Assembly& assembly) {
  constexpr int most_passes = 5;
  Grid grid(options);
  const double whole = 0.5 * options.fibre_length * options.fibre_height;
  HalfFibres halves;
  bool closed = true;
  for (int pass = 0; pass < most_passes && closed; ++pass) {
    halves.clear();
    closed = false;
    const double smallest = (pass == 0 ? smallest_area : smallest_closed) * whole;
    for (int layer = grid.range.first_layer; layer <= grid.range.last_layer; ++layer) {
      for (int column = grid.range.first_column; column <= grid.range.last_column; ++column) {
        Polygon polygon = grid.half_fibre(layer, column);
        if (polygon.empty()) continue;
        if (area(polygon) >= smallest) {
          halves[{layer, column}].polygon = std::move(polygon);
          continue;
        }
        if (pass == 0) ++assembly.dropped;
        closed = grid.close(layer, column, polygon) || closed;
      }
    }
  }
  return halves;
}

// The vertex where the edge of that origin starts; −1 when the clipping left none.
int find_edge(const Polygon& polygon, EdgeOrigin origin) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (polygon[i].edge == origin) return static_cast<int>(i);
  return -1;
}

int add_node(const Vector2d& position, Assembly& assembly) {
  assembly.nodes.push_back(position);
  return static_cast<int>(assembly.nodes.size()) - 1;
}

// The second half of a fibre takes the nodes of the common line from the first; the rest is new.
void add_outline(const HalfFibre* first, int k, HalfFibre& half, Assembly& assembly) {
  const std::size_t n = half.polygon.size(), m = static_cast<std::size_t>(k);
  half.outline.assign(n * m, -1);
  if (first != nullptr) {
    std::vector<int> line = first->edge(EdgeOrigin::head);  // from lower to upper end
    const auto tail = static_cast<std::size_t>(find_edge(half.polygon, EdgeOrigin::tail));
    for (std::size_t i = 0; i <= m; ++i) half.outline[(tail * m + i) % (n * m)] = line[m - i];
  }
  for (std::size_t i = 0; i < n * m; ++i) {
    if (half.outline[i] >= 0) continue;
    const Vector2d &from = half.polygon[i / m].position,
                   &to = half.polygon[(i / m + 1) % n].position;
    const double part = static_cast<double>(i % m) / k;
    half.outline[i] = add_node((1.0 - part) * from + part * to, assembly);
  }
}

// The fan of triangles between the mean of the corners and the outline, each cut into k² alike:
// rings of nodes around the centre, the outermost of which is the outline.
void add_triangles(const HalfFibre& half, int k, Assembly& assembly) {
  const std::size_t n = half.polygon.size(), m = static_cast<std::size_t>(k);
  const Vector2d centre = mean_corner(half.polygon);
  std::vector<std::vector<int>> rings(m + 1);
  rings[m] = half.outline;
  for (std::size_t r = m - 1; r > 0; --r)
    for (std::size_t i = 0; i < n * r; ++i) {
      const std::size_t corner = i / r, along = i % r;
      const Vector2d from = half.polygon[corner].position - centre,
                     to = half.polygon[(corner + 1) % n].position - centre;
      rings[r].push_back(add_node(
          centre + (static_cast<double>(r - along) * from + static_cast<double>(along) * to) / k,
          assembly));
    }
  rings[0].push_back(add_node(centre, assembly));

  const auto node = [&](std::size_t ring, std::size_t edge, std::size_t along) {
    return rings[ring][(edge * ring + along) % rings[ring].size()];
  };
  for (std::size_t edge = 0; edge < n; ++edge)
    for (std::size_t r = 1; r <= m; ++r)
      for (std::size_t i = 0; i < r; ++i) {
        assembly.triangles.push_back(
            {node(r - 1, edge, i), node(r, edge, i), node(r, edge, i + 1)});
        if (i + 1 < r)
          assembly.triangles.push_back(
              {node(r - 1, edge, i), node(r, edge, i + 1), node(r - 1, edge, i + 1)});
      }
}

// One body per fibre; half fibres in order, so the two halves of a fibre follow each other.
void add_bodies(HalfFibres& halves, int refinement, Assembly& assembly) {
  for (auto& [place, half] : halves) {
    const auto [layer, column] = place;
    const HalfFibre* first = nullptr;
    if (!is_first_half(layer, column)) {
      const auto before = halves.find({layer, column - 1});
      if (before != halves.end() && find_edge(before->second.polygon, EdgeOrigin::head) >= 0 &&
          find_edge(half.polygon, EdgeOrigin::tail) >= 0)
        first = &before->second;
    }
    if (first == nullptr)
      assembly.bodies.push_back({static_cast<int>(assembly.nodes.size()), 0,
                                 static_cast<int>(assembly.triangles.size()), 0});
    half.body = static_cast<int>(assembly.bodies.size()) - 1;
    add_outline(first, refinement, half, assembly);
    add_triangles(half, refinement, assembly);
    Body& body = assembly.bodies.back();
    body.nodes = static_cast<int>(assembly.nodes.size()) - body.first_node;
    body.triangles = static_cast<int>(assembly.triangles.size()) - body.first_triangle;
  }
}

// The nodes of edges that lie on a side: a body that only touches it with a corner is not held.
// What is as near as this cannot have anything between itself and the side.
void find_sides(const HalfFibres& halves, double tolerance, Assembly& assembly) {
  const auto x = [&](int node) { return assembly.nodes[static_cast<std::size_t>(node)].x(); };
  for (const auto& [place, half] : halves)
    for (std::size_t i = 0; i < half.polygon.size(); ++i) {
      const std::vector<int> edge = half.edge(i);
      const auto lies = [&](double side) {
        return std::abs(x(edge.front()) - side) <= tolerance &&
               std::abs(x(edge.back()) - side) <= tolerance;
      };
      if (lies(0.0)) assembly.left.insert(assembly.left.end(), edge.begin(), edge.end());
      if (lies(assembly.width))
        assembly.right.insert(assembly.right.end(), edge.begin(), edge.end());
    }
  for (std::vector<int>* side : {&assembly.left, &assembly.right}) {
    std::sort(side->begin(), side->end());
    side->erase(std::unique(side->begin(), side->end()), side->end());
  }
  const auto lower = [&](int a, int b) {
    return assembly.nodes[static_cast<std::size_t>(a)].y() <
           assembly.nodes[static_cast<std::size_t>(b)].y();
  };
  assembly.corner = *std::min_element(assembly.left.begin(), assembly.left.end(), lower);
}

}  // namespace

std::vector<int> HalfFibre::edge(std::size_t i) const {
  const std::size_t pieces = outline.size() / polygon.size();
  std::vector<int> nodes;
  for (std::size_t j = 0; j <= pieces; ++j)
    nodes.push_back(outline[(i * pieces + j) % outline.size()]);
  return nodes;
}

std::vector<int> HalfFibre::edge(EdgeOrigin origin) const {
  const int i = outline.empty() ? -1 : find_edge(polygon, origin);
  return i < 0 ? std::vector<int>() : edge(static_cast<std::size_t>(i));
}

std::vector<double> mean_weights(std::size_t nodes) {
  std::vector<double> weights(nodes, 1.0 / static_cast<double>(nodes - 1));
  weights.front() *= 0.5;
  weights.back() *= 0.5;
  return weights;
}

bool is_first_half(int layer, int column) {
  return ((layer + column) & 1) == 0;
}

double geometric_tolerance(const AssemblyOptions& options) {
  return 1e-9 * std::min(options.fibre_length, options.fibre_height);
}

Assembly build_assembly(const AssemblyOptions& options, Lateral lateral) {
  Assembly assembly;
  assembly.width = options.width();
  assembly.height = options.height();
  HalfFibres halves = clipped_half_fibres(options, assembly);
  add_bodies(halves, options.refinement, assembly);
  add_joints(options, halves, assembly);
  find_sides(halves, 100.0 * geometric_tolerance(options), assembly);
  if (lateral == Lateral::periodic) add_ties(halves, assembly);
  return assembly;
}

}  // namespace havers::sim
