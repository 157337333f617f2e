// Where bodies meet each other, and where top and bottom face each other.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/assembly/half_fibres.hpp"

namespace havers::sim {
namespace {

using Eigen::Vector2d;

constexpr double turned = 1e-12;        // [rad]; less is rounding
constexpr double smallest_part = 1e-6;  // of an edge; no tie is on less, or so near its middle

const Vector2d& at(const Assembly& assembly, int node) {
  return assembly.nodes[static_cast<std::size_t>(node)];
}

// A joint on the common edge of two half fibres, or nothing where the clipping left no edge.
void add_joint(const HalfFibre& a, const HalfFibre& b, Joint joint, Assembly& assembly) {
  const bool head_tail = joint.kind == JointKind::head_tail;
  joint.edge_a = a.edge(head_tail ? EdgeOrigin::head : EdgeOrigin::upper);
  joint.edge_b = b.edge(head_tail ? EdgeOrigin::tail : EdgeOrigin::lower);
  // The halves of a fibre are one body, bonded by their common nodes.
  if (a.body == b.body || joint.edge_a.empty() || joint.edge_b.empty()) return;
  const Vector2d& p = at(assembly, joint.edge_a.front());
  const Vector2d& q = at(assembly, joint.edge_a.back());
  joint.body_a = a.body;
  joint.body_b = b.body;
  joint.position = 0.5 * (p + q);
  joint.length = (q - p).norm();
  // Where a corner was moved to a side, the edges that end there have turned.
  const Vector2d normal = Vector2d(q.y() - p.y(), p.x() - q.x()) / joint.length;
  if ((normal - joint.normal).norm() > turned) joint.normal = normal;
  assembly.joints.push_back(joint);
}

// An edge on the top or bottom side.
struct OuterEdge {
  int body;
  std::vector<int> nodes;  // in the order of x
  double from, to;         // x [m]
};

// The edges whose ends lie within the tolerance of that height, from left to right.
std::vector<OuterEdge> outer_edges(const HalfFibres& halves, const Assembly& assembly, double y,
                                   double tolerance) {
  std::vector<OuterEdge> edges;
  for (const auto& [place, half] : halves) {
    for (std::size_t i = 0; i < half.polygon.size(); ++i) {
      std::vector<int> nodes = half.edge(i);
      if (at(assembly, nodes.front()).x() > at(assembly, nodes.back()).x())
        std::reverse(nodes.begin(), nodes.end());
      const Vector2d &p = at(assembly, nodes.front()), &q = at(assembly, nodes.back());
      if (std::abs(p.y() - y) < tolerance && std::abs(q.y() - y) < tolerance)
        edges.push_back({half.body, nodes, p.x(), q.x()});
    }
  }
  std::ranges::sort(edges, {}, &OuterEdge::from);
  return edges;
}

// The point at x on an edge: two neighbouring nodes and their weights. The middle's displacement is
// known from those of a half fibre's other edges; that of a point just beside it would differ from
// it by rounding, and be held by it.
struct EdgePoint {
  std::array<int, 2> nodes;
  std::array<double, 2> weights;
};

EdgePoint point_on(const OuterEdge& edge, double x) {
  const std::size_t pieces = edge.nodes.size() - 1;
  double part = (x - edge.from) / (edge.to - edge.from);
  if (std::abs(part - 0.5) < smallest_part) part = 0.5;
  const double place = part * static_cast<double>(pieces);
  const std::size_t piece = std::min(static_cast<std::size_t>(place), pieces - 1);
  const double w = place - static_cast<double>(piece);
  return {{edge.nodes[piece], edge.nodes[piece + 1]}, {1.0 - w, w}};
}

}  // namespace

void add_joints(const AssemblyOptions& options, const HalfFibres& halves, Assembly& assembly) {
  const Vector2d axis(std::cos(options.orientation), std::sin(options.orientation));
  Joint head_tail, flank;
  head_tail.kind = JointKind::head_tail;
  head_tail.normal = axis;
  flank.kind = JointKind::flank;
  flank.normal = {-axis.y(), axis.x()};

  // Each half fibre looks ahead and above, so that every pair is found once.
  for (const auto& [place, half] : halves) {
    const auto [layer, column] = place;
    const auto ahead = halves.find({layer, column + 1});
    if (ahead != halves.end()) add_joint(half, ahead->second, head_tail, assembly);
    const auto above = halves.find({layer + 1, column});
    if (above != halves.end()) add_joint(half, above->second, flank, assembly);
  }
}

void add_ties(const HalfFibres& halves, double tolerance, Assembly& assembly) {
  const std::vector<OuterEdge> top = outer_edges(halves, assembly, assembly.height, tolerance);
  const std::vector<OuterEdge> bottom = outer_edges(halves, assembly, 0.0, tolerance);
  const auto length = [](const OuterEdge& edge) { return edge.to - edge.from; };
  // Both sides are walked at once from left to right; where two edges face each other, the middle
  // of what they have in common is tied.
  for (std::size_t t = 0, b = 0; t < top.size() && b < bottom.size();) {
    const double from = std::max(top[t].from, bottom[b].from),
                 to = std::min(top[t].to, bottom[b].to);
    if (to - from > smallest_part * std::min(length(top[t]), length(bottom[b]))) {
      const double x = 0.5 * (from + to);
      const EdgePoint above = point_on(top[t], x), below = point_on(bottom[b], x);
      assembly.ties.push_back(
          {top[t].body, bottom[b].body, above.nodes, below.nodes, above.weights, below.weights});
    }
    if (top[t].to < bottom[b].to)
      ++t;
    else
      ++b;
  }
}

}  // namespace havers::sim
