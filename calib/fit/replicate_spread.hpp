// How much replicates differ, from all specimens of an orientation together.
#pragma once

#include <vector>

#include "calib/fit/prediction.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

/// A specimen's replicates and what their spread depends on.
struct Replicated {
  double orientation = 0.0;  ///< [rad]
  double scatter = 0.0;      ///< d; 0: the spread is its own. [-]
  const Prediction* prediction = nullptr;
};

/// Missing joints scatter replicates too, whatever d is: their spread is their own.
Replicated replicated_of(double orientation, const sim::JointOptions& joints,
                         const Prediction& prediction);

/// Standard deviation between replicates of each landmark, one per specimen: few replicates tell it
/// badly, so that those of one orientation are pooled, in proportion to their scatter (F6).
std::vector<Landmarks> replicate_spread(const std::vector<Replicated>& specimens);

}  // namespace havers::calib
