// The answer of a calibration, and the call that makes it.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "calib/study/study.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {

enum class CalibrationStatus {
  converged,       ///< The optimisers stopped at a minimum.
  budget_spent,    ///< The budget of simulations ended first; the best point so far is given.
  all_failed,      ///< No simulation gave a usable answer.
  nothing_to_fit,  ///< No parameter is informed by the specimens.
  cancelled,       ///< Stopped by the user; run again to go on from the store.
};
std::string to_string(CalibrationStatus status);
std::string explain(CalibrationStatus status);

/// One calibrated value. Numbers in `unit`.
struct CalibratedParameter {
  std::string name;  ///< "young_GPa"; with a level other than shared "young_GPa[A1]" or
                     ///< "young_GPa[45 deg]".
  std::string unit;
  double value = 0.0;
  double standard_error = 0.0;          ///< NaN where not identifiable.
  std::array<double, 2> interval_95{};  ///< NaN where not identifiable.
  std::array<double, 2> bounds{};
  bool at_bound = false;
  bool identifiable = false;
  std::string left_out_because{};  ///< Empty when fitted.
};

/// Mean and standard deviation over replicates.
struct Spread {
  double mean = 0.0, sd = 0.0;
};

/// Simulated curves of one specimen on a common strain grid.
struct CurveBand {
  std::vector<double> strain;                ///< [-]
  std::vector<double> median, lower, upper;  ///< 2.5, 50, 97.5 % over replicates. [Pa]
  std::vector<double> measured;              ///< Interpolated on the grid; NaN beyond its end. [Pa]
  std::vector<double> residual;  ///< Simulated − measured; NaN beyond either end. [Pa]
};

struct SpecimenResult {
  std::string id;
  Use use = Use::fit;
  double orientation = 0.0;  ///< [rad]
  double porosity = 0.0;     ///< NaN where unknown. [-]
  double scatter = 0.0;      ///< d used. [-]
  MeasuredTest measured;
  Spread modulus;                    ///< Simulated. [Pa]
  Spread strength;                   ///< Simulated. [Pa]
  Spread failure_strain;             ///< Simulated. [-]
  std::array<double, 3> residual{};  ///< Standardised, of modulus, strength, failure strain. [-]
  CurveBand band{};
  int failed_simulations = 0;
};

enum class Outcome { pass, warn, fail };
std::string to_string(Outcome outcome);

/// One sentence of the verdict.
struct Check {
  std::string check;
  Outcome outcome = Outcome::fail;
  std::string text;
};

/// One stage of the search, for the report.
struct StageLog {
  std::string optimiser;  ///< "NLopt BOBYQA", "Ceres Levenberg-Marquardt".
  double cost_before = 0.0, cost_after = 0.0;
  int evaluations = 0;
  std::string message{};
  double wall_seconds = std::numeric_limits<double>::quiet_NaN();  ///< NaN where not recorded. [s]
};

struct CalibrationResult {
  CalibrationStatus status = CalibrationStatus::all_failed;
  std::vector<Check> verdict{};
  std::vector<CalibratedParameter> parameters{};
  std::vector<SpecimenResult> specimens{};
  std::vector<StageLog> stages;
  std::vector<sim::LeftOut> left_out{};
  sim::Scene scene;   ///< The calibrated model, ready to simulate.
  double cost = 0.0;  ///< ½ Σ residual² at the optimum. [-]
  /// Standard deviation between specimens beyond noise and the model's own randomness, of log
  /// modulus, log strength and log linearity (F9). [-]
  std::array<double, 3> specimen_effect{};
  long evaluations = 0;  ///< Simulations asked for.
  long simulated = 0;    ///< Of these, run and not found in the store.
  long failed_simulations = 0;
  long distinct_simulations = 0;  ///< Different ones among those asked for.

  /// Status good and no check failed.
  [[nodiscard]] bool trusted() const;
};

/// What the caller may watch: called after every evaluated point of a search. False stops the fit.
struct CalibrationProgress {
  std::string stage;
  long evaluations = 0;
  double best_cost = 0.0;
  std::vector<std::pair<std::string, double>> best;  ///< Parameter name and value, in its unit.
};
using CalibrationObserver = std::function<bool(const CalibrationProgress&)>;

/// Calibrates a study. `store` remembers simulations between runs; null: none.
CalibrationResult calibrate(const Study& study, EvaluationStore* store = nullptr,
                            const CalibrationObserver& observer = {});

}  // namespace havers::calib
