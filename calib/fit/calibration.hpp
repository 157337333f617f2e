// The answer of a calibration, and the call that makes it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "calib/fit/landmarks.hpp"
#include "calib/study/study.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {

/// How a calibration ended.
enum class CalibrationStatus {
  converged,       ///< The optimisers stopped at a minimum.
  budget_spent,    ///< The budget of simulations ended first; the best point so far is given.
  all_failed,      ///< Where searches began or ended, simulations gave some specimen no answer.
  nothing_to_fit,  ///< No parameter is informed by the specimens.
  cancelled,       ///< Stopped by the user; run again to go on from the store.
};
/// In a sentence; the words of result.json are io's.
std::string explain(CalibrationStatus status);

/// One calibrated value. Numbers in `unit`.
struct CalibratedParameter {
  std::string name;  ///< "young_GPa"; with a level other than shared "young_GPa[A1]" or
                     ///< "young_GPa[45 deg]".
  std::string unit;
  double value = 0.0;
  double standard_error = 0.0;  ///< At what is left out; NaN where not identifiable.
  /// By profile likelihood where there is a profile, to the bound where the cost does not rise; by
  /// the slopes otherwise. NaN where not identifiable.
  std::array<double, 2> interval_95{};
  std::array<double, 2> bounds{};
  /// 95 % intervals by the slopes (F11), by profile likelihood (F15) and by bootstrap over
  /// specimens (F16); NaN, with the reason, where there is none.
  std::array<double, 2> slopes_95{std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::quiet_NaN()};
  std::array<double, 2> profile_95 = slopes_95, bootstrap_95 = slopes_95;
  std::string profile_missing{}, bootstrap_missing{};
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
  std::vector<double> median, lower, upper;  ///< 50, 2.5, 97.5 % over replicates. [Pa]
  std::vector<double> measured;              ///< Interpolated on the grid; NaN beyond its end. [Pa]
  std::vector<double> residual;  ///< Simulated − measured; NaN beyond either end. [Pa]
};

/// One term of the objective for one specimen: a landmark (F4), its weight and what it costs.
struct TermResult {
  std::string term;        ///< name_of(Landmark).
  double measured = 0.0;   ///< Landmark of the test. [-]
  double simulated = 0.0;  ///< Mean over the replicates. [-]
  // Standard deviations by source (F6). [-]
  double machine = 0.0;     ///< Of the measurement.
  double replicates = 0.0;  ///< Of one draw of the model against a mean of n.
  double scatter = 0.0;     ///< By the error of the specimen's scatter.
  double specimens = 0.0;   ///< Between specimens, beyond all that.
  double parameters = 0.0;  ///< By the errors of the fit, which did not see this specimen.
  double sd = 0.0;          ///< Of all together.
  double residual = 0.0;    ///< (simulated − measured)/sd; of bounds by (F4) and (F25). [-]
  double share = 0.0;       ///< Of the cost ½ Σ residual² of all fitted specimens. [-]
  bool bound = false;       ///< The test was stopped, and simulations break: `measured` is a bound.
};

/// One simulation at the answer.
struct ReplicateResult {
  std::uint64_t seed = 0;
  bool failed = true;
  bool broke = false;
  double modulus = 0.0;                                  ///< [Pa]
  double strength = 0.0;                                 ///< [Pa]
  double failure_strain = 0.0;                           ///< [-]
  double pre_peak = 0.0, energy = 0.0, post_peak = 0.0;  ///< Landmarks of the curve (F4). [-]
};

/// How a parameter would move without a specimen.
struct Influence {
  std::string parameter;
  /// In standard errors; NaN where the others do not determine it, as what is this specimen's own.
  /// [-]
  double shift = 0.0;
};

/// One specimen at the answer, fitted or kept for validation.
struct SpecimenResult {
  std::string id;
  Use use = Use::fit;
  double orientation = 0.0;          ///< [rad]
  double porosity = 0.0;             ///< NaN where unknown. [-]
  double scatter = 0.0;              ///< d used. [-]
  MeasuredTest measured;             ///< Reduced; whether it broke is as the study says.
  Spread modulus;                    ///< Simulated. [Pa]
  Spread strength;                   ///< Simulated. [Pa]
  Spread failure_strain;             ///< Simulated. [-]
  std::array<double, 3> residual{};  ///< Standardised, of modulus, strength, failure strain. [-]
  /// Those that count for this specimen; empty where its test is of no use or nothing answered.
  std::vector<TermResult> terms{};
  std::vector<ReplicateResult> replicates{};
  std::vector<Influence> influence{};  ///< Of this specimen on each fitted parameter.
  CurveBand band{};
  int failed_simulations = 0;  ///< Of `replicates`.

  /// Of the replicates: how many have an answer, and how many of these did not break.
  [[nodiscard]] long usable() const;
  [[nodiscard]] long unbroken() const;
  [[nodiscard]] bool mostly_unbroken() const { return 2 * unbroken() > usable(); }
};

/// warn: the answer stands, with a reservation. fail: it is not to be trusted.
enum class Outcome { pass, warn, fail };
std::string to_string(Outcome outcome);

/// One sentence of the verdict.
struct Check {
  std::string check;
  Outcome outcome = Outcome::fail;
  std::string text;
  bool done = true;  ///< false: there was nothing to check, which passes.
};

/// One stage of the search, for the report.
struct StageLog {
  std::string optimiser;                       ///< "NLopt BOBYQA", "Ceres Levenberg-Marquardt".
  double cost_before = 0.0, cost_after = 0.0;  ///< ½ Σ residual². [-]
  int evaluations = 0;                         ///< Points, not simulations.
  std::string message{};
  double wall_seconds = std::numeric_limits<double>::quiet_NaN();  ///< NaN where not recorded. [s]
};

/// Rise of the cost along one parameter, the others refitted.
struct Profile {
  std::string parameter;
  std::vector<double> value, rise;      ///< In order of the value; in its unit, and [-].
  double level = 0.0;                   ///< Rise at the ends of the 95 % interval. [-]
  std::array<double, 2> interval_95{};  ///< NaN where the rise does not reach the level.
};

/// What of the answer is the simulations' own chance (F17).
struct Randomness {
  int replicates = 0, replicates_needed = 0;
  /// Variance of differences between points with independent seeds over that with common ones. [-]
  double common_gain = std::numeric_limits<double>::quiet_NaN();
  /// Largest part of a parameter's variance that the replicates' chance makes. [-]
  double simulator_share = std::numeric_limits<double>::quiet_NaN();
  /// With fresh seeds: the cost, and the largest shift of a parameter in standard errors. [-]
  double fresh_cost = std::numeric_limits<double>::quiet_NaN();
  double fresh_shift = std::numeric_limits<double>::quiet_NaN();
  /// Half width of an interval that the fresh seeds' weights make, over that of the answer: of the
  /// parameter in which these differ most. [-]
  double fresh_width = std::numeric_limits<double>::quiet_NaN();
};

/// One replicate in the quasi-static limit and step by step in time.
struct Confirmation {
  std::string specimen;
  std::uint64_t seed = 0;
  double strain_rate = 0.0;  ///< Of the simulation in time. [1/s]
  bool failed = true;
  double strength_limit = 0.0;    ///< [Pa]
  double strength_in_time = 0.0;  ///< Without waves that ring (F21). [Pa]
  double peak_in_time = 0.0;      ///< With single waves. [Pa]
  double failure_strain_limit = 0.0, failure_strain_in_time = 0.0;  ///< [-]
};

/// A further test, and what it would make of the errors.
struct NextTest {
  std::string what;
  std::vector<double> width{};  ///< Standard error of each fitted parameter, after over before. [-]
};

/// All that a fit says. What it did not get to is empty or has its default.
struct CalibrationResult {
  CalibrationStatus status = CalibrationStatus::all_failed;
  std::vector<Check> verdict{};
  std::vector<CalibratedParameter> parameters{};
  std::vector<SpecimenResult> specimens{};
  std::vector<StageLog> stages;
  std::vector<sim::LeftOut> left_out{};
  std::vector<std::string> notes{};                ///< Doubts about the study as it was read.
  std::vector<std::string> fitted{};               ///< Parameters with an interval, in order.
  std::vector<std::vector<double>> correlation{};  ///< Of `fitted`. [-]
  std::vector<std::string> directions{};  ///< What is determined, best first, a sentence each.
  std::vector<Profile> profiles{};
  std::vector<double> starts{}, ends{};  ///< Costs of all starts, and of those refined; best first.
  Randomness randomness{};
  std::vector<Confirmation> confirmations{};
  std::vector<NextTest> next_tests{};
  /// The calibrated model, ready to simulate: what differs between specimens is as the first that
  /// was fitted has it, the seed that of its first replicate.
  sim::Scene scene;
  std::string scene_of{};  ///< That specimen's id; empty where none could be fitted.
  double cost = 0.0;       ///< ½ Σ residual² at the optimum. [-]
  /// Standard deviation between specimens beyond noise and the model's own randomness, of each
  /// landmark (F9). [-]
  std::array<double, landmark_count> specimen_effect{};
  long evaluations = 0;  ///< Simulations asked for.
  long simulated = 0;    ///< Of these, run and not found in the store.
  long failed_simulations = 0;
  std::string most_failed_because{};    ///< Empty where none failed.
  long reserved_simulations = 0;        ///< To be trusted but for what they say.
  std::string most_reserved_because{};  ///< Empty where there is none.
  long distinct_simulations = 0;        ///< Different ones among those asked for.

  /// Status good and no check failed.
  [[nodiscard]] bool trusted() const;
};
/// How the searches ended, where that is why, or which checks failed: no full sentence.
/// Precondition: the result is not trusted.
std::string why_not_trusted(const CalibrationResult& result);

/// The names of the verdict's checks that came to an outcome.
std::vector<std::string> checks_with(const CalibrationResult& result, Outcome outcome);

/// What the caller may watch: called after every evaluated point of a search. False stops the fit.
struct CalibrationProgress {
  std::string stage;
  long evaluations = 0;    ///< Simulations asked for.
  long simulated = 0;      ///< Of these, run and not found in the store.
  double best_cost = 0.0;  ///< ½ Σ residual², by the weights of the stage. [-]
  std::vector<std::pair<std::string, double>> best;  ///< Parameter name and value, in its unit.
};
using CalibrationObserver = std::function<bool(const CalibrationProgress&)>;

/// Calibrates a study. `store` remembers simulations between runs; null: none. `stop_asked` is
/// asked inside the simulations, by all threads; true ends them, and the fit as `cancelled`.
CalibrationResult calibrate(const Study& study, EvaluationStore* store = nullptr,
                            const CalibrationObserver& observer = {},
                            const sim::StopAsked& stop_asked = {});

/// How many of a study's unknowns ask for new simulations when they move from its start. Least
/// squares find the others, whatever the study's local search.
std::size_t costly_unknowns(const Study& study);

}  // namespace havers::calib
