#include "sim/assembly/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "sim/assembly/half_fibres.hpp"

namespace havers::sim {
namespace {

using Eigen::Vector2d;

constexpr double smallest_area = 1e-6;  // of a half fibre

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

Polygon half_fibre_polygon(const AssemblyOptions& options, const FibreFrame& frame, int layer,
                           int column) {
  const double half = 0.5 * options.fibre_length, height = options.fibre_height;
  const double x0 = column * half, x1 = (column + 1) * half, y0 = layer * height,
               y1 = (layer + 1) * height;
  return clip({{frame.to_specimen(x0, y0), EdgeOrigin::lower},
               {frame.to_specimen(x1, y0), EdgeOrigin::head},
               {frame.to_specimen(x1, y1), EdgeOrigin::upper},
               {frame.to_specimen(x0, y1), EdgeOrigin::tail}},
              options.width(), options.height(), geometric_tolerance(options));
}

HalfFibres clipped_half_fibres(const AssemblyOptions& options, Assembly& assembly) {
  const FibreFrame frame(options.orientation);
  const GridRange range = grid_range(options, frame);
  const double whole = 0.5 * options.fibre_length * options.fibre_height;
  HalfFibres halves;
  for (int layer = range.first_layer; layer <= range.last_layer; ++layer) {
    for (int column = range.first_column; column <= range.last_column; ++column) {
      Polygon polygon = half_fibre_polygon(options, frame, layer, column);
      if (polygon.empty()) continue;
      if (area(polygon) >= smallest_area * whole)
        halves[{layer, column}].polygon = std::move(polygon);
      else if (area(polygon) > 1e-12 * whole)
        ++assembly.dropped;
    }
  }
  return halves;
}

bool has_edge(const Polygon& polygon, EdgeOrigin origin) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](const Vertex& v) { return v.edge == origin; });
}

// The second half of a fibre takes the nodes of the common line from the first.
void add_nodes(const HalfFibre* first, HalfFibre& half, Assembly& assembly) {
  const auto shared_node = [&](std::size_t i) {
    if (first == nullptr) return -1;
    const std::size_t n = half.polygon.size();
    const bool starts = half.polygon[i].edge == EdgeOrigin::tail;  // upper end of the line
    const bool ends = half.polygon[(i + n - 1) % n].edge == EdgeOrigin::tail;  // lower end
    if (!starts && !ends) return -1;
    const std::array<int, 2> line = first->edge(EdgeOrigin::head);  // from lower to upper end
    return starts ? line[1] : line[0];
  };
  const auto new_node = [&](const Vector2d& position) {
    assembly.nodes.push_back(position);
    return static_cast<int>(assembly.nodes.size()) - 1;
  };
  for (std::size_t i = 0; i < half.polygon.size(); ++i) {
    const int shared = shared_node(i);
    half.nodes.push_back(shared >= 0 ? shared : new_node(half.polygon[i].position));
  }
  half.nodes.push_back(new_node(centroid(half.polygon)));

  const std::size_t n = half.polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    assembly.triangles.push_back({half.nodes[n], half.nodes[i], half.nodes[(i + 1) % n]});
}

// One body per fibre; half fibres in order, so the two halves of a fibre follow each other.
void add_bodies(HalfFibres& halves, Assembly& assembly) {
  for (auto& [place, half] : halves) {
    const auto [layer, column] = place;
    const HalfFibre* first = nullptr;
    if (!is_first_half(layer, column)) {
      const auto before = halves.find({layer, column - 1});
      if (before != halves.end() && has_edge(before->second.polygon, EdgeOrigin::head) &&
          has_edge(half.polygon, EdgeOrigin::tail))
        first = &before->second;
    }
    if (first == nullptr)
      assembly.bodies.push_back({static_cast<int>(assembly.nodes.size()), 0,
                                 static_cast<int>(assembly.triangles.size()), 0});
    half.body = static_cast<int>(assembly.bodies.size()) - 1;
    add_nodes(first, half, assembly);
    Body& body = assembly.bodies.back();
    body.nodes = static_cast<int>(assembly.nodes.size()) - body.first_node;
    body.triangles = static_cast<int>(assembly.triangles.size()) - body.first_triangle;
  }
}

void find_sides(double tolerance, Assembly& assembly) {
  for (int i = 0; i < static_cast<int>(assembly.nodes.size()); ++i) {
    const Vector2d& p = assembly.nodes[static_cast<std::size_t>(i)];
    if (p.x() <= tolerance) assembly.left.push_back(i);
    if (p.x() >= assembly.width - tolerance) assembly.right.push_back(i);
  }
  const auto lower = [&](int a, int b) {
    return assembly.nodes[static_cast<std::size_t>(a)].y() <
           assembly.nodes[static_cast<std::size_t>(b)].y();
  };
  assembly.corner = *std::min_element(assembly.left.begin(), assembly.left.end(), lower);
}

}  // namespace

std::array<int, 2> HalfFibre::edge(EdgeOrigin origin) const {
  const std::size_t n = polygon.size();
  if (nodes.size() < n) return {-1, -1};
  for (std::size_t i = 0; i < n; ++i)
    if (polygon[i].edge == origin) return {nodes[i], nodes[(i + 1) % n]};
  return {-1, -1};
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
  add_bodies(halves, assembly);
  add_joints(options, halves, assembly);
  find_sides(geometric_tolerance(options), assembly);
  if (lateral == Lateral::periodic) add_ties(halves, assembly);
  return assembly;
}

}  // namespace havers::sim
