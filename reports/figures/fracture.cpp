// Written as SVG without gnuplot: the outlines of all fibres are one path, the joints a few more.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "reports/figures/gnuplot.hpp"
#include "reports/pages.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

using Point = Eigen::Vector2d;

// The assembly as it is drawn: scaled to the figure, y downwards, displacements magnified.
struct Drawing {
  const sim::Assembly& assembly;
  const sim::Simulation& simulation;
  double scale = 1.0;  ///< [px/m]
  double magnification = 1.0;

  [[nodiscard]] Point displacement(int node) const {
    const Eigen::Index i = 2 * static_cast<Eigen::Index>(node);
    // A run without a row has no displacements; those of a run that diverged may not be finite.
    if (i + 1 >= simulation.displacements.size()) return Point::Zero();
    const Point u = simulation.displacements.segment<2>(i);
    return u.allFinite() ? u : Point::Zero();
  }
  [[nodiscard]] Point at(int node) const {
    const Point p =
        assembly.nodes[static_cast<std::size_t>(node)] + magnification * displacement(node);
    return scale * Point(p.x(), assembly.height - p.y());
  }
};

std::string coordinates(const Point& p) {
  return fmt::format("{:.2f} {:.2f}", p.x(), p.y());
}

// The broken joints of a kind.
std::vector<sim::Joint> broken_joints(const Drawing& drawing, sim::JointKind kind) {
  std::vector<sim::Joint> broken;
  const auto& joints = drawing.assembly.joints;
  const auto& outcomes = drawing.simulation.joints;
  for (std::size_t i = 0; i < std::min(joints.size(), outcomes.size()); ++i)
    if (joints[i].kind == kind && outcomes[i].broke()) broken.push_back(joints[i]);
  return broken;
}

// Outline of a body: the edges that one triangle alone has, put end to end.
std::vector<int> outline(const sim::Assembly& assembly, const sim::Body& body) {
  std::map<int, int> next;
  std::map<std::pair<int, int>, int> uses;
  const auto first = assembly.triangles.begin() + body.first_triangle;
  for (auto triangle = first; triangle != first + body.triangles; ++triangle)
    for (std::size_t k = 0; k < 3; ++k)
      ++uses[std::minmax((*triangle)[k], (*triangle)[(k + 1) % 3])];
  for (auto triangle = first; triangle != first + body.triangles; ++triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = (*triangle)[k], b = (*triangle)[(k + 1) % 3];
      if (uses[std::minmax(a, b)] == 1) next[a] = b;
    }
  std::vector<int> nodes;
  if (next.empty()) return nodes;
  // All triangles have the same sense of rotation: each edge of the outline ends where one begins.
  for (int node = next.begin()->first; nodes.size() < next.size(); node = next[node])
    nodes.push_back(node);
  return nodes;
}

std::string fibres(const Drawing& drawing) {
  std::string path;
  for (const sim::Body& body : drawing.assembly.bodies) {
    char step = 'M';
    for (const int node : outline(drawing.assembly, body)) {
      path += step + coordinates(drawing.at(node));
      step = 'L';
    }
    path += 'Z';
  }
  return path;
}

// The opened gaps between the edges of broken joints; a line where a gap is closed.
std::string gaps(const Drawing& drawing, const std::vector<sim::Joint>& joints) {
  std::string path;
  for (const sim::Joint& joint : joints) {
    const Point a = drawing.at(joint.edge_a.front()), b = drawing.at(joint.edge_a.back());
    Point c = drawing.at(joint.edge_b.front()), d = drawing.at(joint.edge_b.back());
    // If both edges run the same way the second is reversed, or the path would cross itself.
    if ((b - a).dot(d - c) > 0.0) std::swap(c, d);
    path += fmt::format("M{}L{}L{}L{}Z", coordinates(a), coordinates(b), coordinates(c),
                        coordinates(d));
  }
  return path;
}

// A diamond in the middle of every joint, so that the kinds differ in grey as well.
std::string diamonds(const Drawing& drawing, const std::vector<sim::Joint>& joints) {
  std::string path;
  for (const sim::Joint& joint : joints) {
    const Point middle =
        0.25 * (drawing.at(joint.edge_a.front()) + drawing.at(joint.edge_a.back()) +
                drawing.at(joint.edge_b.front()) + drawing.at(joint.edge_b.back()));
    path += fmt::format("M{}l3 3-3 3-3-3z", coordinates(middle - Point(0.0, 3.0)));
  }
  return path;
}

// Stretches the largest displacement to about 3 % of the specimen; at least 1.
double magnification_of(const Drawing& drawing) {
  double largest = 0.0;
  for (std::size_t node = 0; node < drawing.assembly.nodes.size(); ++node)
    largest = std::max(largest, drawing.displacement(static_cast<int>(node)).norm());
  const double size = std::max(drawing.assembly.width, drawing.assembly.height);
  return largest > 0.0 ? std::max(1.0, round_down(0.03 * size / largest)) : 1.0;
}

// Corners of the rectangle that holds every node as it is drawn. [px]
std::pair<Point, Point> extent(const Drawing& drawing) {
  Point low = Point::Zero(),
        high = drawing.scale * Point(drawing.assembly.width, drawing.assembly.height);
  for (std::size_t node = 0; node < drawing.assembly.nodes.size(); ++node) {
    low = low.cwiseMin(drawing.at(static_cast<int>(node)));
    high = high.cwiseMax(drawing.at(static_cast<int>(node)));
  }
  return {low, high};
}

// What stands below the specimen: the two kinds of joint, the magnification, the scale bar.
std::string legend(const Drawing& drawing, std::size_t head_tail, std::size_t flank) {
  const double bar = round_down(0.25 * drawing.assembly.width);
  return fmt::format(R"(<path class="head" d="M10 4l3 3-3 3-3-3z"/>
<text x="26" y="12">head-tail joint, broken ({})</text>
<path class="flank" d="M2 27h16"/><text x="26" y="32">flank joint, broken ({})</text>
<text x="270" y="12">displacements × {}</text>
<path class="ink" d="M270 23v8m0-4h{:.2f}m0-4v8"/><text x="{:.1f}" y="32">{} µm</text>)",
                     head_tail, flank, setting(drawing.magnification), drawing.scale * bar,
                     278.0 + drawing.scale * bar, setting(bar / in::um));
}

// `name` is a class of fracture_style.
std::string path(std::string_view name, const std::string& data) {
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", name, data);
}

// An arrow outwards on either side: the loading direction.
std::string arrows(double left, double right, double middle) {
  return fmt::format(
      R"(<path class="ink" d="M{:.1f} {:.1f}h-34m7-6l-7 6 7 6M{:.1f} {:.1f}h34m-7-6l7 6-7 6"/>)",
      left - 10.0, middle, right + 10.0, middle);
}

constexpr std::string_view fracture_style =
    "<style>.fracture .fibre{fill:#f3ead6;stroke:#a89a7c;stroke-width:.5}"
    ".fracture .gap{fill-opacity:.35;stroke-width:.8}"
    ".fracture .head{fill:#d55e00;stroke:#d55e00}"
    ".fracture .flank{fill:#0072b2;stroke:#0072b2}"
    ".fracture .ink{fill:none;stroke:#333;stroke-width:1.5}"
    ".fracture text{font:13px sans-serif;fill:#222}</style>";

}  // namespace

std::string fracture_svg(const sim::Assembly& assembly, const sim::Simulation& simulation) {
  if (assembly.bodies.empty() || !(assembly.width > 0.0) || !(assembly.height > 0.0))
    return sentence_svg("Nothing to draw: the assembly is empty.");
  Drawing drawing{.assembly = assembly, .simulation = simulation};
  drawing.scale = std::min(760.0 / assembly.width, 560.0 / assembly.height);
  drawing.magnification = magnification_of(drawing);
  const auto head_tail = broken_joints(drawing, sim::JointKind::head_tail);
  const auto flank = broken_joints(drawing, sim::JointKind::flank);
  const auto [low, high] = extent(drawing);
  // Margins: for the arrows on the sides, for the legend below. [px]
  constexpr double side = 54.0, above = 8.0, below = 60.0;
  // At least as wide as the legend, with the specimen in the middle.
  const double width = std::max(high.x() - low.x() + 2.0 * side, 600.0);
  const double x = 0.5 * (low.x() + high.x() - width);
  return fmt::format(
             R"(<svg xmlns="http://www.w3.org/2000/svg" class="fracture" role="img" width="100%"
 viewBox="{:.1f} {:.1f} {:.1f} {:.1f}">
<title>The broken assembly: {} head-tail and {} flank joints broken, loaded along the horizontal</title>
{})",
             x, low.y() - above, width, high.y() - low.y() + above + below, head_tail.size(),
             flank.size(), fracture_style) +
         path("fibre", fibres(drawing)) + path("gap flank", gaps(drawing, flank)) +
         path("gap head", gaps(drawing, head_tail)) + path("head", diamonds(drawing, head_tail)) +
         arrows(low.x(), high.x(), 0.5 * (low.y() + high.y())) +
         fmt::format("<g transform=\"translate({:.1f} {:.1f})\">{}</g></svg>\n", x + side,
                     high.y() + 18.0, legend(drawing, head_tail.size(), flank.size()));
}

}  // namespace havers::reports
