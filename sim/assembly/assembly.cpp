// From half fibres to a mesh: outlines, in which the halves of a fibre share their common line,
// fans of triangles in them, and the nodes that the machine holds. Bodies come before joints and
// sides, which are found by the nodes of the bodies' edges.
#include "sim/assembly/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "sim/assembly/half_fibres.hpp"

namespace havers::sim {
namespace {

using Eigen::Vector2d;

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
    // All edges run anticlockwise: the tail from its upper end to the lower one.
    const auto tail = static_cast<std::size_t>(find_edge(half.polygon, EdgeOrigin::tail));
    for (std::size_t i = 0; i <= m; ++i) half.outline[(tail * m + i) % (n * m)] = line[m - i];
  }
  // Each edge is divided into k equal parts; corners are among the nodes.
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
  // Ring r lies at r/k of the way from the centre to the outline and has r nodes for each edge.
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

  // On a ring an edge ends at the node at which the next one begins.
  const auto node = [&](std::size_t ring, std::size_t edge, std::size_t along) {
    return rings[ring][(edge * ring + along) % rings[ring].size()];
  };
  // Between ring r − 1 and ring r: r triangles with their base on the outer one, and r − 1 with it
  // on the inner one, k² for each edge in all.
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
    // Halves without a common line, where the clipping took it or the other half, are bodies of
    // their own.
    const HalfFibre* first = nullptr;
    if (!is_first_half(layer, column)) {
      const auto before = halves.find({layer, column - 1});
      if (before != halves.end() && find_edge(before->second.polygon, EdgeOrigin::head) >= 0 &&
          find_edge(half.polygon, EdgeOrigin::tail) >= 0)
        first = &before->second;
    }
    if (first == nullptr)
      assembly.bodies.push_back({static_cast<int>(assembly.nodes.size()), 0,
                                 static_cast<int>(assembly.triangles.size()), 0, layer,
                                 is_first_half(layer, column) ? column : column - 1});
    half.body = static_cast<int>(assembly.bodies.size()) - 1;
    add_outline(first, refinement, half, assembly);
    add_triangles(half, refinement, assembly);
    // Both halves count: what the second adds comes right behind the nodes and triangles of the
    // first.
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
    // Edges that meet have a node in common, which is kept once.
    std::ranges::sort(*side);
    side->erase(std::unique(side->begin(), side->end()), side->end());
  }
  const auto y = [&](int node) { return assembly.nodes[static_cast<std::size_t>(node)].y(); };
  assembly.corner = *std::ranges::min_element(assembly.left, {}, y);
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
  const int i = find_edge(polygon, origin);
  return i < 0 ? std::vector<int>() : edge(static_cast<std::size_t>(i));
}

std::vector<double> mean_weights(std::size_t nodes) {
  // The trapezoidal rule on pieces of the same length.
  std::vector<double> weights(nodes, 1.0 / static_cast<double>(nodes - 1));
  weights.front() *= 0.5;
  weights.back() *= 0.5;
  return weights;
}

bool is_first_half(int layer, int column) {
  // Turned specimens have layers and columns below 0, of which & 1 tells the parity as well.
  return ((layer + column) & 1) == 0;
}

double geometric_tolerance(const AssemblyOptions& options) {
  return 1e-9 * std::min(options.fibre_length, options.fibre_height);
}

Assembly build_assembly(const AssemblyOptions& options, Lateral lateral) {
  Assembly assembly;
  assembly.width = options.width();
  assembly.height = options.height();
  HalfFibres halves = clipped_half_fibres(options, assembly.dropped);
  add_bodies(halves, options.refinement, assembly);
  add_joints(options, halves, assembly);
  const double tolerance = 100.0 * geometric_tolerance(options);
  find_sides(halves, tolerance, assembly);
  if (lateral == Lateral::periodic) add_ties(halves, tolerance, assembly);
  return assembly;
}

}  // namespace havers::sim
