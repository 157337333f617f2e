#include "sim/structure/dissection.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

namespace havers::sim {
namespace {

// Bodies are cut apart along the sides of cells of so many layers and half fibres, so that pieces
// are congruent: both even, as layers are laid in running bond.
constexpr std::array<int, 2> cell_size{8, 16};
constexpr std::size_t few = 64;  // bodies, which minimum degree orders as well
constexpr int least_part = 3;    // of its cells is the smaller half of a piece

using Cell = std::array<int, 2>;  // across and along the fibres

// The first cells of a row that are cut off: so many that their number has few binary digits, and
// that neither half is small.
int cells_cut_off(int count) {
  int unit = 1;
  while (2 * unit < count) unit *= 2;
  for (;; unit /= 2) {
    const int first = unit * std::max(1, (count + unit) / (2 * unit));
    if (unit == 1 || least_part * std::min(first, count - first) >= count) return first;
  }
}

// Cuts pieces in two again and again. The unknowns that a cut crosses are a part, and so are those
// of a piece that is not cut; parts are numbered in the order of their elimination.
class Halves {
 public:
  Halves(const Assembly& assembly, const std::vector<std::array<int, 2>>& bodies_of)
      : bodies_of_(bodies_of), second_(assembly.bodies.size(), 0), part_(bodies_of.size(), 0) {
    const int layer = std::ranges::min(assembly.bodies, {}, &Body::layer).layer;
    const int column = std::ranges::min(assembly.bodies, {}, &Body::column).column;
    const Cell first{layer, column - ((layer + column) & 1)};
    cells_.reserve(assembly.bodies.size());
    for (const Body& body : assembly.bodies)
      cells_.push_back(
          {(body.layer - first[0]) / cell_size[0], (body.column - first[1]) / cell_size[1]});
  }

  // The last to come is cut first.
  std::vector<int> parts() {
    struct Piece {
      std::span<int> bodies;
      std::vector<int> unknowns;
    };
    std::vector<int> bodies(cells_.size()), unknowns(bodies_of_.size());
    std::iota(bodies.begin(), bodies.end(), 0);
    std::iota(unknowns.begin(), unknowns.end(), 0);
    std::vector<Piece> pieces{{bodies, std::move(unknowns)}};
    int earlier = 0;
    for (; !pieces.empty(); ++earlier) {
      const Piece piece = std::move(pieces.back());
      pieces.pop_back();
      std::array<std::vector<int>, 3> sets;  // of the halves, and cut
      if (const std::size_t first = cut(piece.bodies, piece.unknowns); first > 0) {
        for (const int unknown : piece.unknowns) sets[side_of(unknown)].push_back(unknown);
        pieces.push_back({piece.bodies.first(first), std::move(sets[0])});
        pieces.push_back({piece.bodies.subspan(first), std::move(sets[1])});
      } else {
        sets[2] = piece.unknowns;
      }
      for (const int unknown : sets[2]) part_[static_cast<std::size_t>(unknown)] = -earlier;
    }
    for (int& part : part_) part += earlier - 1;
    return std::move(part_);
  }

 private:
  // The way that fewer of the unknowns cross. How many bodies are in the first half; none if they
  // are few or of one cell.
  std::size_t cut(std::span<int> bodies, const std::vector<int>& unknowns) {
    if (bodies.size() <= few) return 0;
    std::ptrdiff_t least = std::ssize(unknowns) + 1;
    std::size_t across = 0;
    int at = 0;
    for (const std::size_t axis : {1U, 0U}) {
      const auto of = [&](int body) { return cells_[static_cast<std::size_t>(body)][axis]; };
      const auto [lowest, highest] = std::ranges::minmax(bodies, {}, of);
      const int low = of(lowest), cells = of(highest) - low + 1;
      if (cells == 1) continue;
      const int beyond = low + cells_cut_off(cells);
      halve(bodies, axis, beyond);
      const std::ptrdiff_t crossed =
          std::ranges::count(unknowns, 2U, [&](int unknown) { return side_of(unknown); });
      if (crossed >= least) continue;
      least = crossed;
      across = axis;
      at = beyond;
    }
    if (least > std::ssize(unknowns)) return 0;
    halve(bodies, across, at);
    const auto second = std::stable_partition(bodies.begin(), bodies.end(), [&](int body) {
      return second_[static_cast<std::size_t>(body)] == 0;
    });
    return static_cast<std::size_t>(second - bodies.begin());
  }

  void halve(std::span<const int> bodies, std::size_t axis, int at) {
    for (const int body : bodies)
      second_[static_cast<std::size_t>(body)] =
          cells_[static_cast<std::size_t>(body)][axis] < at ? 0 : 1;
  }

  // 0 or 1, or 2 if it is cut.
  [[nodiscard]] std::size_t side_of(int unknown) const {
    const auto [a, b] = bodies_of_[static_cast<std::size_t>(unknown)];
    const std::size_t side = second_[static_cast<std::size_t>(a)];
    return side == second_[static_cast<std::size_t>(b)] ? side : 2;
  }

  const std::vector<std::array<int, 2>>& bodies_of_;
  std::vector<Cell> cells_;            // of bodies
  std::vector<unsigned char> second_;  // whether a body is in the second half
  std::vector<int> part_;              // of each unknown
};

}  // namespace

std::vector<int> dissection(const Assembly& assembly,
                            const std::vector<std::array<int, 2>>& bodies_of) {
  return Halves(assembly, bodies_of).parts();
}

}  // namespace havers::sim
