// What is measured on every run of a sweep, and what several runs of a point say together.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "calib/fit/statistics.hpp"
#include "calib/sweep/pattern.hpp"
#include "calib/sweep/plan.hpp"
#include "sim/scene.hpp"

namespace havers::calib {

/// What is measured on a run. The number of a measure is its place in all arrays of measures.
enum class Measure {
  strength,          ///< [Pa]
  failure_strain,    ///< [-]
  modulus,           ///< [Pa]
  linear_part,       ///< Strain at which the stress lacks 1 % of the strength of Eε, and of the
                     ///< viscous Eτε̇ beside it, over failure strain. [-]
  fall_part,         ///< Strain from the strength to the end of the run, over failure strain. [-]
  head_tail_broken,  ///< Broken head-tail joints.
  flank_broken,      ///< Broken flank joints.
  crack_span,        ///< Height that the largest chain of broken joints spans, over H. [-]
  crack_linked,      ///< Part of the broken head-tail joints that a broken flank continues. [-]
};
/// In the order of their numbers.
inline constexpr std::array all_measures{
    Measure::strength,     Measure::failure_strain, Measure::modulus,
    Measure::linear_part,  Measure::fall_part,      Measure::head_tail_broken,
    Measure::flank_broken, Measure::crack_span,     Measure::crack_linked};
inline constexpr std::size_t measure_count = all_measures.size();

/// A point of a sweep: the values of its keys, and the scene they make.
struct SweepPoint {
  std::vector<std::string> values;  ///< Texts without quotes, in the order of the plan's keys.
  std::vector<double> numbers;      ///< The same as numbers; NaN for words.
  sim::Scene scene;
  int level = 1;
  double inertia_number = 0.0;  ///< I (M12), by `inertia_of`. [-]
};

/// I (M12) of a scene; NaN where the scene asks for the quasi-static limit, which no rate enters.
double inertia_of(const sim::Scene& scene);

/// One simulation of a point, and what was measured on it.
struct SweepRun {
  std::size_t point = 0;
  std::uint64_t seed = 0;
  bool failed = true, broke = false;
  std::string why;  ///< It failed; else what it is to be trusted but for, if anything.
  std::array<double, measure_count> measures{};  ///< NaN where not known; SI units.
  /// Curve, of a point's first run that has not failed. [-], [Pa]
  std::vector<double> strain, stress;

  [[nodiscard]] double operator[](Measure m) const {
    return measures.at(static_cast<std::size_t>(m));
  }
  /// The strain limit came first: strength and failure strain are lower bounds.
  [[nodiscard]] bool unbroken() const { return !failed && !broke; }
  /// Whether it is to be trusted only with the reservation that `why` states.
  [[nodiscard]] bool reserved() const { return !failed && !why.empty(); }
};

/// The measures of a scene's response; those of the pattern where there is one.
std::array<double, measure_count> measures_of(const Response& response, const sim::Scene& scene,
                                              const Pattern* pattern);

/// The runs of one point together.
struct PointSummary {
  long runs = 0, failed = 0, unbroken = 0;  ///< Unbroken: the strain limit came first.
  long reserved = 0;                        ///< To be trusted but for what the run says.
  std::array<Statistics, measure_count> measures{};

  [[nodiscard]] const Statistics& operator[](Measure m) const {
    return measures.at(static_cast<std::size_t>(m));
  }
};

/// Whether a run that did not break leaves a measure open: all but the modulus.
bool needs_break(Measure m);

/// Whether a measure is a part of a whole, from 0 to 1.
bool is_share(Measure m);

/// A measure of all runs of a point that tell it: that did not fail and, where it `needs_break`,
/// broke. A bound is not among values.
std::vector<double> values_of(const std::vector<SweepRun>& runs, std::size_t point, Measure m);

/// Runs among them that did not break and leave `m` open.
long unbroken_of(const std::vector<SweepRun>& runs, const std::vector<std::size_t>& points,
                 Measure m);

/// Counts all runs of a point, and sums up those that tell each measure.
PointSummary summary_of(const std::vector<SweepRun>& runs, std::size_t point);

/// Which points share the value of a key: their value and their indices, in order; one group of
/// all, without a value, for an empty key. Points of the second level are in no group.
struct PointGroup {
  std::string value;
  std::vector<std::size_t> points;
};
std::vector<PointGroup> groups_of(const std::vector<SweepPoint>& points, const SweepPlan& plan,
                                  const std::string& key);

}  // namespace havers::calib
