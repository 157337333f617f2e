// Which things hang together.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace havers::sim {

/// Sets of the numbers below n, at first each its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// One of the set's members, the same for all of them.
  [[nodiscard]] std::size_t find(std::size_t i) {
    // Paths to the root are halved in passing, and so stay short.
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The set of `into` takes in that of `other`; its `find` stays.
  void unite(std::size_t into, std::size_t other) { parent_[find(other)] = find(into); }

 private:
  std::vector<std::size_t> parent_;  // a root is its own parent
};

}  // namespace havers::sim
