#include "calib/sweep/pattern.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "sim/structure/disjoint_sets.hpp"

namespace havers::calib {
namespace {

using Place = std::pair<long, long>;  // a point, rounded so that equal points are equal

struct Segment {
  sim::JointKind kind = sim::JointKind::flank;
  bool broke = true;  // false: missing from the start; a crack runs through it
  std::array<Eigen::Vector2d, 2> ends;
  std::array<Place, 2> places;
};

// A joint lies in the middle of its segment, which runs along its tangent. Ends that two segments
// share differ by rounding only.
std::vector<Segment> broken_segments(const sim::Assembly& assembly,
                                     const std::vector<sim::JointOutcome>& joints) {
  const double unit = 1e-7 * std::max(assembly.width, assembly.height);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!joints[i].broken) continue;
    const sim::Joint& joint = assembly.joints[i];
    Segment segment{.kind = joint.kind, .broke = joints[i].broke(), .ends = {}, .places = {}};
    for (std::size_t k = 0; k < 2; ++k) {
      segment.ends[k] = joint.position + (k == 0 ? -0.5 : 0.5) * joint.length * joint.tangent();
      segment.places[k] = {std::lround(segment.ends[k].x() / unit),
                           std::lround(segment.ends[k].y() / unit)};
    }
    segments.push_back(segment);
  }
  return segments;
}

// Height of the highest chain: of the segments that hang together by common ends.
double highest_chain(const std::vector<Segment>& segments) {
  sim::DisjointSets chains(segments.size());
  std::map<Place, std::size_t> at;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const Place& place : segments[i].places)
      // Joined with the first segment that ends there, and so with all others.
      chains.unite(at.try_emplace(place, i).first->second, i);

  std::map<std::size_t, std::pair<double, double>> extent;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const Eigen::Vector2d& end : segments[i].ends) {
      auto& [low, high] = extent.try_emplace(chains.find(i), end.y(), end.y()).first->second;
      low = std::min(low, end.y());
      high = std::max(high, end.y());
    }
  double highest = 0.0;
  for (const auto& [chain, ends] : extent) highest = std::max(highest, ends.second - ends.first);
  return highest;
}

}  // namespace

Pattern pattern_of(const sim::Assembly& assembly, const std::vector<sim::JointOutcome>& joints) {
  assert(assembly.joints.size() == joints.size());
  const std::vector<Segment> segments = broken_segments(assembly, joints);
  // The ends of all flanks are collected first, so that each head-tail joint can be looked up in
  // them.
  std::set<Place> flank_ends;
  Pattern pattern;
  for (const Segment& segment : segments) {
    if (segment.kind != sim::JointKind::flank || !segment.broke) continue;
    ++pattern.flank;
    flank_ends.insert(segment.places.begin(), segment.places.end());
  }
  // All that broke, less the flanks.
  pattern.head_tail =
      static_cast<int>(std::ranges::count(segments, true, &Segment::broke)) - pattern.flank;
  const auto linked = std::ranges::count_if(segments, [&](const Segment& segment) {
    return segment.kind == sim::JointKind::head_tail && segment.broke &&
           (flank_ends.contains(segment.places[0]) || flank_ends.contains(segment.places[1]));
  });
  pattern.linked = pattern.head_tail > 0 ? static_cast<double>(linked) / pattern.head_tail
                                         : std::numeric_limits<double>::quiet_NaN();
  pattern.span = highest_chain(segments) / assembly.height;
  return pattern;
}

}  // namespace havers::calib
