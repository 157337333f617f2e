// A study: specimens, the model to start from, and what to calibrate.
#pragma once

#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/experiment/measured_test.hpp"
#include "calib/porosity/scatter_map.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]

/// Whether a specimen is fitted, or kept to be predicted by the fit.
enum class Use { fit, validate };

/// One test with the sections of the same bone, read and reduced.
struct Specimen {
  std::string id;
  Use use = Use::fit;
  bool broke = true;         ///< false: the test was stopped; its strength is a lower bound.
  double orientation = 0.0;  ///< θ. [rad]
  MeasuredTest test;
  std::vector<SectionPorosity> sections;  ///< May be empty.
  std::optional<double> porosity;         ///< Given in the study instead of sections. [-]
};

/// Over what a calibrated value is shared.
enum class Level { shared, orientation, specimen };

/// How the neighbourhood of the answer is found: starts spread over the bounds, or one of NLopt's
/// global methods.
enum class GlobalSearch { starts, crs2, direct, mlsl, esch };

/// How a start is refined where new simulations are needed. `automatic`: COBYLA for one unknown,
/// BOBYQA for more.
enum class LocalSearch { automatic, bobyqa, sbplx, cobyla };

/// As many replicates as it takes for their chance not to matter.
inline constexpr int replicates_by_need = 0;

/// What to calibrate, and how. Values in the parameters' own units.
struct CalibrateOptions {
  std::vector<std::string> parameters{"young_GPa", "head_tail_MPa", "ratio"};
  bool automatic = false;  ///< parameters = "auto": try all, keep what the specimens inform.
  std::map<std::string, std::pair<double, double>> bounds;  ///< Overrides of the defaults.
  std::map<std::string, Level> level;                       ///< Default: shared.
  /// Terms of the objective (F4) that count; also "pre-peak curve", "energy", "post-peak drop".
  std::vector<std::string> terms{"modulus", "strength", "failure strain"};
  int replicates = 8;  ///< Seeds per specimen, or replicates_by_need.
  /// The same seeds at every point of a search (F2); false: each point has its own, to compare
  /// with.
  bool common_seeds = true;
  GlobalSearch global = GlobalSearch::starts;
  LocalSearch local = LocalSearch::automatic;
  bool smooth = true;      ///< Least squares by Ceres after the derivative-free search.
  bool profiles = true;    ///< Profile likelihood of every parameter.
  int confirm = 0;         ///< Simulations step by step in time that check the quasi-static answer.
  int budget = 400;        ///< Points with all specimens and replicates that may be simulated.
  std::uint64_t seed = 1;  ///< Of the replicates' seeds and of the optimisers' random starts.
  int threads = 0;         ///< 0: as many as the machine has. Never changes a number.

  /// Its key is one of a study's [calibrate]: "options.replicates".
  using Problem = sim::Scene::Problem;
  /// All that is wrong; empty when usable.
  [[nodiscard]] std::vector<Problem> problems() const;
};

/// A law of strength that a sweep found: Σ coefficient · term + constant, for one value of a key.
struct SweepLaw {
  std::string per;  ///< assembly.orientation_deg, joints.ratio, or empty: it holds everywhere.
  double at = 0.0;  ///< Its value of that key.
  std::vector<std::string> terms;    ///< joints.scatter, joints.ratio.
  std::vector<double> coefficients;  ///< Those of the terms, then the constant. [Pa]
};

/// A study whose files are read, ready to be fitted.
struct Study {
  std::string name;
  std::vector<Specimen> specimens;
  sim::Scene
      model;  ///< Starting point; orientation, scatter, strain rate and seed are set per specimen.
  PorosityOptions porosity;
  CalibrateOptions calibrate;
  std::vector<SweepLaw> laws;  ///< Of strength, for the model to be better than.
};

}  // namespace havers::calib
