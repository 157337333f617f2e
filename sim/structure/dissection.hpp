// Where to cut an assembly, so that its elimination fills little.
#pragma once

#include <array>
#include <vector>

#include "sim/assembly/assembly.hpp"

namespace havers::sim {

/// Nested dissection [Geo73] across or along the fibres, whatever cuts less: unknowns of one half
/// feel those of the other only through those cut, which come after both. What is cut off is of few
/// shapes, so that a factor repeats itself.
/// @param bodies_of  each unknown: the two that share it, or twice the one whose own it is
/// @return the part of each unknown, in the order of elimination
std::vector<int> dissection(const Assembly& assembly,
                            const std::vector<std::array<int, 2>>& bodies_of);

}  // namespace havers::sim
