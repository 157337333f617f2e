#include "calib/fit/replicate_spread.hpp"

#include <map>

namespace havers::calib {
namespace {

/// Σ ν sd²/d² and Σ ν over the specimens of an orientation.
struct Pool {
  Landmarks squares = Landmarks::Zero();
  double freedom = 0.0;
};

// A single replicate shows no spread, which does not mean that there is none.
bool counts(const Replicated& specimen) {
  return specimen.scatter > 0.0 && specimen.prediction->usable > 1;
}

}  // namespace

Replicated replicated_of(double orientation, const sim::JointOptions& joints,
                         const Prediction& prediction) {
  return {.orientation = orientation,
          .scatter = joints.missing > 0.0 ? 0.0 : joints.scatter,
          .prediction = &prediction};
}

std::vector<Landmarks> replicate_spread(const std::vector<Replicated>& specimens) {
  // By orientation [rad].
  std::map<double, Pool> pools;
  for (const Replicated& specimen : specimens) {
    if (!counts(specimen)) continue;
    Pool& pool = pools[specimen.orientation];
    const double freedom = specimen.prediction->usable - 1.0;
    pool.squares += freedom * (specimen.prediction->sd / specimen.scatter).square();
    pool.freedom += freedom;
  }
  std::vector<Landmarks> spread;
  for (const Replicated& specimen : specimens) {
    const Pool& pool = pools[specimen.orientation];
    const bool pooled = specimen.scatter > 0.0 && pool.freedom > 0.0;
    spread.emplace_back(pooled ? Landmarks(specimen.scatter * (pool.squares / pool.freedom).sqrt())
                               : specimen.prediction->sd);
  }
  return spread;
}

}  // namespace havers::calib
