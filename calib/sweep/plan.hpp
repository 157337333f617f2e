// Where a sweep looks: the points of a list, a grid or a sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/scene.hpp"

namespace havers::calib {

/// list: the first values of all keys, the second ones, ...; grid: every combination; the samples
/// fill the box between two bounds for each key.
enum class Sampling { list, grid, latin_hypercube, sobol };

/// Whether keys have bounds instead of values.
bool is_sample(Sampling sampling);

/// A key of a scene and what it takes, as TOML values.
struct SweepKey {
  std::string name;                 ///< Dotted: "joints.scatter".
  std::vector<std::string> values;  ///< Of a sample: lower and upper bound.
};

/// The number that a TOML value is; NaN when it is none.
double number_in(const std::string& value);

constexpr int most_sample_points = 100'000;  ///< Of a sample.
constexpr double most_runs = 1e6;            ///< Of all points: what memory holds.

/// Which points, and how many runs of each.
struct SweepPlan {
  Sampling sampling = Sampling::grid;
  std::vector<SweepKey> keys;
  int points = 32;         ///< Of a sample.
  int seeds = 20;          ///< Runs for each point, every run with a seed of its own.
  std::uint64_t seed = 1;  ///< Of the first run, and of the Latin hypercube.

  /// Its key is one of [sweep].
  using Problem = sim::Scene::Problem;
  /// All that is wrong; empty when it can be run.
  [[nodiscard]] std::vector<Problem> problems() const;
  /// The place of a key; the number of keys for one that does not vary.
  [[nodiscard]] std::size_t column(const std::string& key) const;
};

/// The values of every key, point by point, as TOML values. Bounds of a sample that are a factor
/// of 100 apart are filled by the logarithm. Precondition: plan.problems() is empty.
std::vector<std::vector<std::string>> points_of(const SweepPlan& plan);

}  // namespace havers::calib
