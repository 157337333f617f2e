// What the replicates of one specimen say together.
#pragma once

#include <span>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "calib/fit/landmarks.hpp"

namespace havers::calib {

/// Landmarks of a response. Precondition: it has not failed.
Landmarks landmarks_of(const Response& response);

/// Landmarks of one specimen over its replicates.
struct Prediction {
  std::vector<Landmarks>
      replicates;  ///< NaN where a simulation failed, so that replicates pair up. [-]
  Landmarks mean = Landmarks::Zero();  ///< Over those that answered; 0 where none did. [-]
  Landmarks sd = Landmarks::Zero();    ///< Between replicates; 0 of a single one. [-]
  int usable = 0;                      ///< Replicates that answered.
  bool censored = false;               ///< Most did not break: the strength is a lower bound.

  [[nodiscard]] int failed() const { return static_cast<int>(replicates.size()) - usable; }
  /// Half of the replicates must have answered.
  [[nodiscard]] bool failed_point() const {
    return 2 * usable < static_cast<int>(replicates.size());
  }
};

/// Precondition: at least one response.
Prediction summarise(std::span<const Response> responses);

}  // namespace havers::calib
