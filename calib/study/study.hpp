// A study: specimens, the model to start from, and what to calibrate.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/experiment/measured_test.hpp"
#include "calib/porosity/scatter_map.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

enum class Use { fit, validate };

/// One test with the sections of the same bone, read and reduced.
struct Specimen {
  std::string id;
  Use use = Use::fit;
  double orientation = 0.0;  ///< θ. [rad]
  MeasuredTest test;
  std::vector<SectionPorosity> sections;  ///< May be empty.
  std::optional<double> porosity;         ///< Given in the study instead of sections. [-]
};

/// Over what a calibrated value is shared.
enum class Level { shared, orientation, specimen };

/// What to calibrate, and how. Values in the parameters' own units.
struct CalibrateOptions {
  std::vector<std::string> parameters{"young_GPa", "head_tail_MPa", "ratio"};
  bool automatic = false;  ///< parameters = "auto": try all, keep what the specimens inform.
  std::map<std::string, std::pair<double, double>> bounds;  ///< Overrides of the defaults.
  std::map<std::string, Level> level;                       ///< Default: shared.
  int replicates = 8;                                       ///< Seeds per specimen.
  int budget = 400;                                         ///< Simulations of one specimen's set.
  std::uint64_t seed = 1;  ///< Of the replicates' seeds and of the optimisers' random starts.
  int threads = 0;         ///< 0: as many as the machine has. Never changes a number.

  /// What is wrong, a sentence each; empty when usable.
  [[nodiscard]] std::vector<std::string> problems() const;
};

struct Study {
  std::string name;
  std::vector<Specimen> specimens;
  sim::Scene
      model;  ///< Starting point; orientation, scatter, strain rate and seed are set per specimen.
  PorosityOptions porosity;
  CalibrateOptions calibrate;
};

}  // namespace havers::calib
