// Which joints of a run have broken.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/simulation.hpp"

namespace havers::test {

inline std::vector<std::size_t> broken_joints(const std::vector<sim::JointOutcome>& joints) {
  std::vector<std::size_t> broken;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].broken) broken.push_back(j);
  return broken;
}

}  // namespace havers::test
