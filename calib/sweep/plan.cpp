#include "calib/sweep/plan.hpp"

#include <Random123/philox.h>
#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "calib/count.hpp"

namespace havers::calib {
namespace {

using Unit = std::vector<std::vector<double>>;  // points in [0, 1)^keys

// A permutation of the strata for each key, by sorting random numbers, and a random place in each
// stratum [MCB79]. The random numbers are functions of point, key and seed alone.
Unit latin_hypercube(std::size_t points, std::size_t keys, std::uint64_t seed) {
  Unit unit(points, std::vector<double>(keys));
  for (std::size_t key = 0; key < keys; ++key) {
    std::vector<std::pair<std::uint64_t, std::size_t>> order(points);
    std::vector<double> place(points);
    for (std::size_t i = 0; i < points; ++i) {
      const auto bits = r123::Philox2x64()({{i, key}}, {{seed}});
      order[i] = {bits[0], i};
      // The upper 53 bits, as many as a double holds: in [0, 1).
      place[i] = static_cast<double>(bits[1] >> 11) * 0x1p-53;
    }
    std::ranges::sort(order);
    for (std::size_t stratum = 0; stratum < points; ++stratum) {
      const std::size_t i = order[stratum].second;
      unit[i][key] = (static_cast<double>(stratum) + place[i]) / static_cast<double>(points);
    }
  }
  return unit;
}

// The first points of the sequence, which has no seed.
Unit sobol(std::size_t points, std::size_t keys) {
  const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(keys)), gsl_qrng_free);
  Unit unit(points, std::vector<double>(keys));
  for (auto& point : unit) gsl_qrng_get(sequence.get(), point.data());
  return unit;
}

// The value at `part` of the way from the lower bound to the upper, as the text of a TOML number.
std::string between(const SweepKey& key, double part) {
  const double low = number_in(key.values[0]), high = number_in(key.values[1]);
  // Bounds two decades or more apart are spanned by their logarithms, unless the lower has none.
  const bool by_logarithm = low > 0.0 && high >= 100.0 * low;
  return fmt::format("{:.9g}",
                     by_logarithm ? low * std::pow(high / low, part) : low + part * (high - low));
}

std::vector<std::vector<std::string>> sample(const SweepPlan& plan) {
  const auto points = static_cast<std::size_t>(plan.points);
  const Unit unit = plan.sampling == Sampling::sobol
                        ? sobol(points, plan.keys.size())
                        : latin_hypercube(points, plan.keys.size(), plan.seed);
  std::vector<std::vector<std::string>> rows(points);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t key = 0; key < plan.keys.size(); ++key)
      rows[i].push_back(between(plan.keys[key], unit[i][key]));
  return rows;
}

// The last key runs fastest.
std::vector<std::vector<std::string>> grid(const std::vector<SweepKey>& keys) {
  std::vector<std::vector<std::string>> rows{{}};
  for (const SweepKey& key : keys) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& row : rows)
      for (const std::string& value : key.values) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    rows = std::move(longer);
  }
  return rows;
}

std::vector<std::vector<std::string>> list(const std::vector<SweepKey>& keys) {
  std::vector<std::vector<std::string>> rows(keys.front().values.size());
  for (const SweepKey& key : keys)
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(key.values[i]);
  return rows;
}

// The number of runs of all points and seeds. A double, as a grid soon exceeds what an integer
// holds.
double runs_of(const SweepPlan& plan) {
  double points = is_sample(plan.sampling) ? plan.points : 1.0;
  for (const SweepKey& key : plan.keys)
    if (plan.sampling == Sampling::grid) points *= static_cast<double>(key.values.size());
  if (plan.sampling == Sampling::list && !plan.keys.empty())
    points = static_cast<double>(plan.keys.front().values.size());
  return points * plan.seeds;
}

}  // namespace

bool is_sample(Sampling sampling) {
  return sampling == Sampling::latin_hypercube || sampling == Sampling::sobol;
}

double number_in(const std::string& value) {
  double number = 0.0;
  const char* const end = value.data() + value.size();
  // A number with anything behind it is none.
  const auto [read_until, error] = std::from_chars(value.data(), end, number);
  return read_until == end && error == std::errc() ? number : std::nan("");
}

std::vector<SweepPlan::Problem> SweepPlan::problems() const {
  std::vector<Problem> all;
  const auto complain = [&](const char* key, std::string what) {
    all.push_back({key, std::move(what)});
  };
  if (keys.empty()) complain("keys", "names no keys to vary");
  if (seeds < 1) complain("seeds", fmt::format("is {}, must be 1 or more", seeds));
  if (is_sample(sampling) && (points < 1 || points > most_sample_points))
    complain("points", fmt::format("is {}, must be from 1 to {}", points, most_sample_points));
  if (sampling == Sampling::sobol && keys.size() > 40)
    complain("keys", "has more keys than the 40 dimensions of the Sobol sequence");
  for (const SweepKey& key : keys) {
    if (key.values.empty()) complain("keys", fmt::format("gives {} no values", key.name));
    // The values of a list go together, so each key needs as many.
    if (sampling == Sampling::list && key.values.size() != keys.front().values.size())
      complain("keys", fmt::format("is a list, but {} has {} and {} has {}", key.name,
                                   count(key.values.size(), "value"), keys.front().name,
                                   keys.front().values.size()));
    // A bound that is no number is NaN, which is not less than anything.
    if (is_sample(sampling) &&
        !(key.values.size() == 2 && number_in(key.values.front()) < number_in(key.values.back())))
      complain("keys", fmt::format("is a sample, but {} has no lower and upper bound", key.name));
  }
  if (const double runs = runs_of(*this); runs > most_runs)
    complain("seeds", fmt::format("is {}, and all points make {:.3g} runs, must be at most {:.0e}",
                                  seeds, runs, most_runs));
  return all;
}

std::size_t SweepPlan::column(const std::string& key) const {
  return static_cast<std::size_t>(std::ranges::find(keys, key, &SweepKey::name) - keys.begin());
}

std::vector<std::vector<std::string>> points_of(const SweepPlan& plan) {
  if (plan.sampling == Sampling::list) return list(plan.keys);
  return plan.sampling == Sampling::grid ? grid(plan.keys) : sample(plan);
}

}  // namespace havers::calib
