// The joints of an assembly in the order in which they broke.
#pragma once

#include <string>

#include "sim/simulation.hpp"

namespace havers::reports {

/// Every joint as a line; the broken ones coloured by the moment of breaking, and shown one after
/// the other by an animation inside the SVG. Viewers without animation show all of them.
std::string avalanche_svg(const sim::Assembly& assembly, const sim::Simulation& simulation);

}  // namespace havers::reports
