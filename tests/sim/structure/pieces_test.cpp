#include "sim/structure/pieces.hpp"

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// A chain of five fibres, whose joints are in order.
TEST(Pieces, HangOnAnEndAsFarAsJointsHold) {
  const Assembly assembly =
      build_assembly(test::small_scene(0.0, 1, 5).assembly, Lateral::periodic);
  DisjointSets whole = pieces_of(assembly, [](std::size_t) { return true; });
  EXPECT_TRUE(ends_hang_together(assembly, whole));
  DisjointSets apart = pieces_of(assembly, [](std::size_t joint) { return joint % 2 == 0; });
  EXPECT_FALSE(ends_hang_together(assembly, apart));
  for (std::size_t body = 0; body < 5; ++body) {
    EXPECT_TRUE(hangs_on_an_end(assembly, whole, body));
    EXPECT_EQ(hangs_on_an_end(assembly, apart, body), body < 2 || body == 4) << body;
  }
}

}  // namespace
}  // namespace havers::sim
