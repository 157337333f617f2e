#include "sim/structure/dissection.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace havers::sim {
namespace {

using Eigen::Vector2d;

constexpr std::size_t few = 60;  // bodies, which minimum degree orders as well

class Halves {
 public:
  Halves(const Assembly& assembly, const std::vector<std::array<int, 2>>& bodies_of)
      : bodies_of_(bodies_of), second_(assembly.bodies.size(), 0), part_(bodies_of.size(), 0) {
    centres_.reserve(assembly.bodies.size());
    for (const Body& body : assembly.bodies) {
      Vector2d sum = Vector2d::Zero();
      for (int node = body.first_node; node < body.first_node + body.nodes; ++node)
        sum += assembly.nodes[static_cast<std::size_t>(node)];
      centres_.emplace_back(sum / body.nodes);
    }
    if (!assembly.joints.empty())
      axes_ = {assembly.joints.front().normal, assembly.joints.front().tangent()};
  }

  // The last to come is cut first.
  std::vector<int> parts() {
    struct Piece {
      std::span<int> bodies;
      std::vector<int> unknowns;
    };
    std::vector<int> bodies(centres_.size()), unknowns(bodies_of_.size());
    std::iota(bodies.begin(), bodies.end(), 0);
    std::iota(unknowns.begin(), unknowns.end(), 0);
    std::vector<Piece> pieces{{bodies, std::move(unknowns)}};
    int earlier = 0;
    for (; !pieces.empty(); ++earlier) {
      const Piece piece = std::move(pieces.back());
      pieces.pop_back();
      std::array<std::vector<int>, 3> sets;  // of the halves, and cut
      if (piece.bodies.size() <= few) {
        sets[2] = piece.unknowns;
      } else {
        cut(piece.bodies, piece.unknowns);
        for (const int unknown : piece.unknowns) sets[side_of(unknown)].push_back(unknown);
        const std::size_t half = piece.bodies.size() / 2;
        pieces.push_back({piece.bodies.first(half), std::move(sets[0])});
        pieces.push_back({piece.bodies.subspan(half), std::move(sets[1])});
      }
      for (const int unknown : sets[2]) part_[static_cast<std::size_t>(unknown)] = -earlier;
    }
    for (int& part : part_) part += earlier - 1;
    return std::move(part_);
  }

 private:
  // The way that fewer of the unknowns cross.
  void cut(std::span<int> bodies, const std::vector<int>& unknowns) {
    halve(bodies, axes_[0]);
    const auto across = crossing(unknowns);
    halve(bodies, axes_[1]);
    if (across < crossing(unknowns)) halve(bodies, axes_[0]);
  }

  void halve(std::span<int> bodies, const Vector2d& axis) {
    const auto place = [&](int body) { return centres_[static_cast<std::size_t>(body)].dot(axis); };
    const auto half = bodies.size() / 2;
    std::ranges::nth_element(bodies, bodies.begin() + static_cast<std::ptrdiff_t>(half), {}, place);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      second_[static_cast<std::size_t>(bodies[i])] = i < half ? 0 : 1;
  }

  // 0 or 1, or 2 if it is cut.
  [[nodiscard]] std::size_t side_of(int unknown) const {
    const auto [a, b] = bodies_of_[static_cast<std::size_t>(unknown)];
    const std::size_t side = second_[static_cast<std::size_t>(a)];
    return side == second_[static_cast<std::size_t>(b)] ? side : 2;
  }
  [[nodiscard]] std::ptrdiff_t crossing(const std::vector<int>& unknowns) const {
    return std::ranges::count(unknowns, 2U, [&](int unknown) { return side_of(unknown); });
  }

  const std::vector<std::array<int, 2>>& bodies_of_;
  std::vector<Vector2d> centres_;  // of bodies
  std::array<Vector2d, 2> axes_{Vector2d::UnitX(), Vector2d::UnitY()};
  std::vector<unsigned char> second_;  // whether a body is in the second half
  std::vector<int> part_;              // of each unknown
};

}  // namespace

std::vector<int> dissection(const Assembly& assembly,
                            const std::vector<std::array<int, 2>>& bodies_of) {
  return Halves(assembly, bodies_of).parts();
}

}  // namespace havers::sim
