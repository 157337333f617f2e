// What a simulation really depends on: in the quasi-static limit neither on E nor on σ₁.
#pragma once

#include <string>

#include "calib/fit/evaluation_store.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

/// A scene to simulate, and how its response becomes that of the scene asked for (F3).
struct NormalForm {
  sim::Scene scene;
  bool scaled = false;         ///< false: the scene is the one asked for, the factors are 1.
  double stress_factor = 1.0;  ///< [-]
  double strain_factor = 1.0;  ///< [-]
  double max_strain = 0.0;     ///< Strain limit of the scene asked for. [-]
};

/// The normal form of a scene. `quasi_static` says that the simulator takes the limit, where
/// stresses scale with the thresholds and strains with threshold/E; otherwise nothing is changed.
NormalForm normal_form(const sim::Scene& scene, bool quasi_static);

/// The response of the scene asked for, cut at its strain limit.
Response rescaled(Response response, const NormalForm& form);

/// A text that names everything a response depends on, with the version of the model.
std::string key_of(const sim::Scene& scene);

}  // namespace havers::calib
