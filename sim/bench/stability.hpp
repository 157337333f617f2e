// Stiff and extreme scenes whose answer is known before they are run.
#pragma once

#include <string>
#include <vector>

#include "sim/simulation.hpp"

namespace havers::sim {

/// A scene, and what must come out of it.
struct StabilityScene {
  std::string name;
  Scene scene;
  bool refused = false;  ///< Must be refused: it has no answer.
};

/// At least forty. The closed forms they are judged by hold for the bonded specimen, in both
/// regimes: σ = E(ε + τε̇) (M1), and the strain at which that stress first breaks a joint. A row of
/// fibres in the quasi-static limit is also as strong as its weakest joint.
std::vector<StabilityScene> stability_scenes();

/// How a scene of known answer came out.
enum class StabilityOutcome {
  solved,   ///< Trusted, and the known answer within the limits.
  refused,  ///< Not run, with a reason.
  failed,   ///< The run says itself that it found no answer.
  wrong,    ///< The run is trusted and misses the known answer, or a number is not finite.
};

/// The outcome as one word.
std::string to_string(StabilityOutcome outcome);

/// What became of one scene; numbers are 0 where it was refused.
struct StabilityResult {
  std::string name;
  StabilityOutcome outcome = StabilityOutcome::failed;
  bool as_it_must = false;     ///< Solved, or refused where it must be.
  std::string reason;          ///< Why refused, failed or wrong.
  double residual = 0.0;       ///< (M11). [-]
  double energy_defect = 0.0;  ///< (M4). [-]
  double penetration = 0.0;    ///< Relative to the fibre length. [-]
  double error = 0.0;          ///< Relative, of modulus, first break and a row's strength. [-]
  double wall = 0.0;           ///< [s]
};

/// Refuses the scene, or runs it for a minute at most and judges it.
StabilityResult run_stability_scene(const StabilityScene& scene, const StopAsked& stop_asked = {});

/// All scenes that were run, in order.
struct StabilityBench {
  std::vector<StabilityResult> scenes;
  bool complete = false;  ///< false: stopped before the last scene.

  /// Whether all did what they must.
  [[nodiscard]] bool good() const;
};

/// How many did what they must, in a sentence.
std::string summary(const StabilityBench& bench);

}  // namespace havers::sim
