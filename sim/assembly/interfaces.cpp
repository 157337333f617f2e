// Where bodies meet each other, and where top and bottom face each other.
#include <algorithm>
#include <cmath>

#include "sim/assembly/half_fibres.hpp"

namespace havers::sim {
namespace {

using Eigen::Vector2d;

const Vector2d& at(const Assembly& assembly, int node) {
  return assembly.nodes[static_cast<std::size_t>(node)];
}

// A joint on the common edge of two half fibres, or nothing where the clipping left no edge.
void add_joint(const HalfFibre& a, EdgeOrigin side_a, const HalfFibre& b, EdgeOrigin side_b,
               Joint joint, Assembly& assembly) {
  joint.edge_a = a.edge(side_a);
  joint.edge_b = b.edge(side_b);
  if (a.body == b.body || joint.edge_a[0] < 0 || joint.edge_b[0] < 0) return;
  const Vector2d& p = at(assembly, joint.edge_a[0]);
  const Vector2d& q = at(assembly, joint.edge_a[1]);
  joint.body_a = a.body;
  joint.body_b = b.body;
  joint.position = 0.5 * (p + q);
  joint.length = (q - p).norm();
  assembly.joints.push_back(joint);
}

// An edge on the top or bottom side.
struct OuterEdge {
  int body;
  std::array<int, 2> nodes;  // in the order of x
  double from, to;           // x [m]
};

std::vector<OuterEdge> outer_edges(const HalfFibres& halves, const Assembly& assembly, double y) {
  const double tolerance = 1e-9 * assembly.height;
  std::vector<OuterEdge> edges;
  for (const auto& [place, half] : halves) {
    const std::size_t n = half.polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      std::array<int, 2> nodes{half.nodes[i], half.nodes[(i + 1) % n]};
      if (at(assembly, nodes[0]).x() > at(assembly, nodes[1]).x()) std::swap(nodes[0], nodes[1]);
      const Vector2d &p = at(assembly, nodes[0]), &q = at(assembly, nodes[1]);
      if (std::abs(p.y() - y) < tolerance && std::abs(q.y() - y) < tolerance)
        edges.push_back({half.body, nodes, p.x(), q.x()});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const auto& a, const auto& b) { return a.from < b.from; });
  return edges;
}

std::array<double, 2> weights(const OuterEdge& edge, double x) {
  const double w = (x - edge.from) / (edge.to - edge.from);
  return {1.0 - w, w};
}

}  // namespace

void add_joints(const AssemblyOptions& options, const HalfFibres& halves, Assembly& assembly) {
  const Vector2d axis(std::cos(options.orientation), std::sin(options.orientation));
  Joint head_tail, flank;
  head_tail.kind = JointKind::head_tail;
  head_tail.normal = axis;
  flank.kind = JointKind::flank;
  flank.normal = {-axis.y(), axis.x()};

  for (const auto& [place, half] : halves) {
    const auto [layer, column] = place;
    const auto ahead = halves.find({layer, column + 1});
    if (ahead != halves.end())
      add_joint(half, EdgeOrigin::head, ahead->second, EdgeOrigin::tail, head_tail, assembly);
    const auto above = halves.find({layer + 1, column});
    if (above != halves.end())
      add_joint(half, EdgeOrigin::upper, above->second, EdgeOrigin::lower, flank, assembly);
  }
}

void add_ties(const HalfFibres& halves, Assembly& assembly) {
  const std::vector<OuterEdge> top = outer_edges(halves, assembly, assembly.height);
  const std::vector<OuterEdge> bottom = outer_edges(halves, assembly, 0.0);
  const double tolerance = 1e-9 * assembly.width;
  for (std::size_t t = 0, b = 0; t < top.size() && b < bottom.size();) {
    const double from = std::max(top[t].from, bottom[b].from),
                 to = std::min(top[t].to, bottom[b].to);
    if (to - from > tolerance) {
      const double x = 0.5 * (from + to);
      assembly.ties.push_back({top[t].body, bottom[b].body, top[t].nodes, bottom[b].nodes,
                               weights(top[t], x), weights(bottom[b], x)});
    }
    if (top[t].to < bottom[b].to)
      ++t;
    else
      ++b;
  }
}

}  // namespace havers::sim
