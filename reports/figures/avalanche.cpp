// One path holds all joints of one moment, so that the file stays small. SMIL shows the paths one
// after the other, without a script; viewers without SMIL show all at once.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "reports/figures/gnuplot.hpp"
#include "reports/pages.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

constexpr double width = 760.0;       // of the specimen [px]
constexpr double turn_seconds = 8.0;  // of one turn of the animation [s]
constexpr double part_shown = 0.8;    // of it, while joints break; then the crack stands still
constexpr std::size_t moments = 48;   // At most so many paths, however many joints break.

struct Broken {
  std::size_t joint = 0;
  double strain = 0.0;
};

// Sorted by strain; joints that broke at the same strain stay in the order of the assembly.
std::vector<Broken> in_order(const sim::Simulation& simulation) {
  std::vector<Broken> broken;
  for (std::size_t i = 0; i < simulation.joints.size(); ++i)
    if (simulation.joints[i].broke()) broken.push_back({i, simulation.joints[i].broken_at_strain});
  std::ranges::stable_sort(broken, {}, &Broken::strain);
  return broken;
}

// Dark blue, green, yellow, as read by the colour-blind and in grey: the later the brighter.
std::string colour_at(double part) {
  constexpr std::array<std::array<double, 3>, 4> stops{
      {{68, 1, 84}, {49, 104, 142}, {53, 183, 121}, {240, 180, 20}}};
  const double at = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  std::array<long, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb.at(c) = std::lround(
        std::lerp(stops.at(i).at(c), stops.at(i + 1).at(c), at - static_cast<double>(i)));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

// A joint at its place before the load; y points downwards in SVG.
std::string line_of(const sim::Assembly& assembly, std::size_t index, double scale) {
  const sim::Joint& joint = assembly.joints[index];
  const Eigen::Vector2d half = 0.5 * scale * joint.length * joint.tangent();
  const Eigen::Vector2d middle =
      scale * Eigen::Vector2d(joint.position.x(), assembly.height - joint.position.y());
  return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", middle.x() - half.x(), middle.y() + half.y(),
                     middle.x() + half.x(), middle.y() - half.y());
}

// The joints that break in one moment: hidden until then.
std::string moment(const std::string& path, double part) {
  return fmt::format(R"(<path d="{}" stroke="{}"><animate attributeName="stroke-opacity" )"
                     R"(values="0;0;1;1" keyTimes="0;{:.4f};{:.4f};1" dur="{}s" )"
                     R"(repeatCount="indefinite"/></path>
)",
                     path, colour_at(part), part_shown * part, part_shown * part + 0.01,
                     turn_seconds);
}

std::string legend(const std::vector<Broken>& broken, double y) {
  std::string svg;
  for (int i = 0; i < 40; ++i)
    svg += fmt::format(R"(<rect x="{}" y="{:.1f}" width="5" height="10" fill="{}" stroke="none"/>)",
                       5 * i, y, colour_at(i / 39.0));
  return svg +
         fmt::format(R"(<text x="212" y="{:.1f}">from the first break, at {}, to the last, at {}: )"
                     R"({}</text>)",
                     y + 10.0, quantity(broken.front().strain / in::percent, "%"),
                     quantity(broken.back().strain / in::percent, "%"),
                     count(broken.size(), "broken joint"));
}

}  // namespace

std::string avalanche_svg(const sim::Assembly& assembly, const sim::Simulation& simulation) {
  const std::vector<Broken> broken = in_order(simulation);
  if (broken.empty()) return sentence_svg("Nothing to draw: no joint broke.");
  const double scale = width / assembly.width, height = scale * assembly.height;
  std::string bonds, breaks;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) bonds += line_of(assembly, i, scale);
  // Moments hold equal numbers of joints, not equal strains: in an avalanche many joints break at
  // nearly one strain.
  const std::size_t chunk = (broken.size() + moments - 1) / moments;
  for (std::size_t at = 0; at < broken.size(); at += chunk) {
    std::string path;
    for (std::size_t i = at; i < std::min(at + chunk, broken.size()); ++i)
      path += line_of(assembly, broken[i].joint, scale);
    breaks += moment(path, static_cast<double>(at) / static_cast<double>(broken.size()));
  }
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" role="img" width="100%" viewBox="-6 -6 {:.0f} {:.0f}"
 font-family="sans-serif" font-size="13" fill="none">
<title>Joints in the order in which they broke, loaded along the horizontal</title>
<rect width="{:.1f}" height="{:.1f}" fill="#f3ead6" stroke="#a89a7c"/>
<path d="{}" stroke="#c9bd9f" stroke-width=".6"/>
<g stroke-width="2.6" stroke-linecap="round">
{}</g><g fill="#222">{}</g></svg>
)",
      width + 12.0, height + 44.0, width, height, bonds, breaks, legend(broken, height + 16.0));
}

}  // namespace havers::reports
