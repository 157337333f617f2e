// Runs the settings in turn and measures them by a reference of the same seed. In time the direct
// solver's steps come first, as the step of the reference depends on which of them end within the
// time limit.
#include "sim/bench/work_precision.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/outcome.hpp"

namespace havers::sim {
namespace {

using Eigen::VectorXd;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double no_limit = 1e9;  // [s]

struct SettingRuns {
  BenchSetting setting;
  std::vector<WatchedRun> runs;  // over the seeds; none yet: empty
};

// The direct solver's: the exact sequence or, in time, a quarter of the shortest step with which
// all runs end, so that it takes but a few times as long as these. Most steps would be of uniform
// motion.
void choose_reference(const Scene& scene, const std::vector<SettingRuns>& settings,
                      WorkPrecision& study) {
  study.reference = direct_setting(scene);
  study.reference_ground = "the exact breaking sequence of the quasi-static limit";
  if (study.reference.regime == Regime::quasi_static) {
    study.reference.leave_out = false;
    return;
  }
  double shortest = base_step(scene);
  bool some_ended = false;
  for (const auto& [setting, runs] : settings)
    if (!runs.empty() && std::ranges::all_of(runs, has_ended, &WatchedRun::simulation)) {
      some_ended = true;
      for (const WatchedRun& run : runs)
        if (run.simulation.step > 0.0)  // one that is severed is answered in the limit
          shortest = std::min(shortest, run.simulation.step);
    }
  study.reference.step = shortest / 4.0;
  study.reference.leap = true;
  study.reference_ground =
      some_ended ? "a quarter of the shortest step whose runs ended in time, solved directly"
                 : "a quarter of the longest step, as no run ended in time, solved directly";
}

double relative_error(double value, double reference) {
  return std::abs(value - reference) / std::abs(reference);
}

double relative_error(const VectorXd& forces, const VectorXd& reference) {
  if (forces.size() == 0 || forces.size() != reference.size()) return not_known;
  return (forces - reference).norm() / reference.norm();
}

double curve_error(const Simulation& run, const Simulation& reference) {
  // By the midpoint rule up to the reference's failure; a curve that ends before counts as 0 from
  // there on.
  constexpr int points = 200;
  double squares = 0.0;
  for (int i = 1; i <= points; ++i) {
    const double strain = reference.failure_strain * (i - 0.5) / points;  // not where it falls
    const double difference = stress_at(run.curve, strain).value_or(0.0) -
                              stress_at(reference.curve, strain).value_or(0.0);
    squares += difference * difference;
  }
  return std::sqrt(squares / points) / reference.strength;
}

// Spread of the values that are known; NaN where none is.
BenchSpread spread(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {not_known, not_known, not_known};
  std::sort(values.begin(), values.end());
  return {gsl_stats_median_from_sorted_data(values.data(), 1, values.size()), values.front(),
          values.back(), static_cast<int>(values.size())};
}

using Runs = std::span<const WatchedRun>;  // over the seeds

// A number of every run, as a spread.
template <class Number>
BenchSpread over(Runs runs, const Number& number) {
  std::vector<double> values;
  for (std::size_t i = 0; i < runs.size(); ++i) values.push_back(number(i));
  return spread(std::move(values));
}

// The reference of the forces before the first break is known in closed form, but for a shock.
// Whether it is.
bool take_exact_forces(const Scene& scene, double strain, std::vector<WatchedRun>& references) {
  if (scene.loading.start == Start::rest || scene.material.viscosity > 0.0 ||
      scene.material.layer_contrast != 1.0 || some_are_missing(scene.joints))
    return false;
  for (WatchedRun& reference : references)
    reference.bonded_forces = bonded_forces_at(scene, strain);
  return true;
}

BenchErrors errors_of(Runs runs, Runs references) {
  const auto if_ended = [&](const auto& error) {
    return over(runs, [&](std::size_t i) {
      const Simulation &run = runs[i].simulation, &reference = references[i].simulation;
      return has_ended(run) && has_ended(reference) ? error(run, reference) : not_known;
    });
  };
  return {
      .bonded_forces = over(runs,
                            [&](std::size_t i) {
                              return relative_error(runs[i].bonded_forces,
                                                    references[i].bonded_forces);
                            }),
      .forces = over(runs, [&](std::size_t i) { return force_error(runs[i], references[i]); }),
      .strength = if_ended([](const Simulation& run, const Simulation& reference) {
        return relative_error(run.strength, reference.strength);
      }),
      .strength_without_ringing = if_ended([](const Simulation& run, const Simulation& reference) {
        return relative_error(run.strength_without_ringing(), reference.strength_without_ringing());
      }),
      .failure_strain = if_ended([](const Simulation& run, const Simulation& reference) {
        return relative_error(run.failure_strain, reference.failure_strain);
      }),
      .curve = if_ended(curve_error)};
}

BenchRow row_of(const BenchSetting& setting, Runs runs, Runs references) {
  BenchRow row{.setting = setting, .runs = static_cast<int>(runs.size())};
  row.setting.leap = false;  // but where motion was uniform
  for (const WatchedRun& run : runs) {
    row.setting.leap = row.setting.leap || (setting.leap && run.simulation.leapt_strain > 0.0);
    row.trusted += run.simulation.trusted() ? 1 : 0;
    row.out_of_time += run.out_of_time ? 1 : 0;
  }
  row.errors = errors_of(runs, references);
  row.wall = over(runs, [&](std::size_t i) { return runs[i].wall; });
  row.cpu = over(runs, [&](std::size_t i) { return runs[i].cpu; });
  row.steps = over(runs, [&](std::size_t i) { return runs[i].simulation.steps; });
  const auto last_strain = [&](std::size_t i) {
    const std::vector<CurvePoint>& curve = runs[i].simulation.curve;
    return curve.empty() ? 0.0 : curve.back().strain;
  };
  row.reached = over(runs, last_strain);
  row.stopped_at =
      over(runs, [&](std::size_t i) { return runs[i].out_of_time ? last_strain(i) : not_known; });
  row.iterations =
      over(runs, [&](std::size_t i) { return static_cast<double>(runs[i].simulation.iterations); });
  row.same_breaks = over(runs, [&](std::size_t i) {
    return static_cast<double>(same_breaks(runs[i], references[i]));
  });
  return row;
}

double largest(const BenchErrors& errors) {
  double most = not_known;
  for (const BenchSpread& error :
       {errors.bonded_forces, errors.forces, errors.strength, errors.strength_without_ringing,
        errors.failure_strain, errors.curve})
    most = std::fmax(most, error.high);  // what is not known does not count
  return most;
}

// Of the last row and the one before it, where they are alike but for what they leave out.
std::optional<Omissions> omissions_of(const std::vector<BenchRow>& rows, Runs runs,
                                      Runs runs_before) {
  const BenchRow &row = rows.back(), &before = rows[rows.size() - 2];
  if (row.setting == before.setting || without_omissions(row.setting) != before.setting) return {};
  // A run without omissions that was stopped is compared as far as it came; all others have to be
  // trusted.
  if (row.trusted < row.runs || before.trusted + before.out_of_time < before.runs) return {};
  // After a run that was stopped the seeds that follow are not run.
  const BenchErrors errors =
      errors_of(runs.first(std::min(runs.size(), runs_before.size())), runs_before);
  Omissions omissions{.setting = row.setting,
                      .change = before.out_of_time > 0
                                    ? std::fmax(errors.bonded_forces.high, errors.forces.high)
                                    : largest(errors),
                      .cpu_ratio = before.cpu.median / row.cpu.median};
  if (!std::isfinite(omissions.change)) return {};
  if (before.out_of_time > 0) {  // a run that was stopped has a CPU time of a step only
    omissions.cpu_ratio *= row.steps.median / std::max(1.0, before.steps.median);
    omissions.until_strain = before.stopped_at.low;
  }
  return omissions;
}

// Runs settings over the seeds; remembers nothing but whether somebody asked to stop.
class Bench {
 public:
  Bench(const Scene& scene, const BenchObserver& observer, const WorkPrecision& study)
      : scene_(scene), observer_(observer), study_(study) {}

  [[nodiscard]] bool stopped() const { return stopped_; }

  std::vector<WatchedRun> run(const BenchSetting& setting, double time_limit) {
    std::vector<WatchedRun> runs;
    for (const std::uint64_t seed : study_.seeds) {
      const std::string next = fmt::format("{}, seed {}", to_string(setting), seed);
      const auto stop_asked = [&] {
        stopped_ = stopped_ || (observer_ && !observer_(next));
        return stopped_;
      };
      if (stop_asked()) return runs;
      Scene scene = with_setting(setting, scene_);
      scene.joints.seed = seed;
      runs.push_back(watch(scene, {study_.bonded_strain, time_limit}, stop_asked));
      if (runs.back().out_of_time) break;  // others would hardly end
    }
    return runs;
  }

 private:
  const Scene& scene_;
  const BenchObserver& observer_;
  const WorkPrecision& study_;
  bool stopped_ = false;
};

}  // namespace

WorkPrecision compare_settings(const Scene& scene, const BenchOptions& options,
                               const BenchObserver& observer) {
  WorkPrecision study{.bonded_strain = std::numeric_limits<double>::infinity(),
                      .time_limit = options.time_limit};
  // Forces are compared at a strain at which no seed's specimen has broken yet.
  for (Scene seeded = scene; std::ssize(study.seeds) < options.seeds; ++seeded.joints.seed) {
    study.seeds.push_back(seeded.joints.seed);
    study.bonded_strain =
        std::min(study.bonded_strain, 0.4 * first_break_by_uniform_stress(seeded));
  }

  Bench bench(scene, observer, study);
  std::vector<SettingRuns> settings;
  for (const BenchSetting& setting : bench_settings(scene)) settings.push_back({setting, {}});
  const BenchSetting direct = direct_setting(scene);
  for (auto& [setting, runs] : settings) {  // for the step that the reference can have
    BenchSetting but_for_step = setting;
    but_for_step.step.reset();
    if (direct.regime == Regime::dynamic && but_for_step == direct)
      runs = bench.run(setting, options.time_limit);
  }
  if (bench.stopped()) return study;
  choose_reference(scene, settings, study);
  std::optional<BenchSetting> twice_its_step;
  if (study.reference.step) {
    twice_its_step = study.reference;
    twice_its_step->step = 2.0 * *study.reference.step;
    settings.insert(std::ranges::find_if(settings, has_chosen_steps, &SettingRuns::setting),
                    {*twice_its_step, {}});
    const BenchSpread none = spread({});  // until that has run
    study.reference_errors = {none, none, none, none, none, none};
  }
  std::vector<WatchedRun> references = bench.run(study.reference, no_limit);
  if (bench.stopped()) return study;
  // The reference's own forces are kept for its row: errors may be measured by exact ones instead.
  std::vector<WatchedRun> before = references;
  study.closed_form = take_exact_forces(scene, study.bonded_strain, references);
  study.rows.push_back(row_of(study.reference, before, references));
  // It leaps where one of its runs did.
  study.reference.leap = study.rows.front().setting.leap;
  for (auto& [setting, runs] : settings) {
    const bool of_reference = twice_its_step == setting;
    if (runs.empty()) runs = bench.run(setting, of_reference ? no_limit : options.time_limit);
    if (bench.stopped()) break;
    study.rows.push_back(row_of(setting, runs, references));
    if (of_reference) study.reference_errors = study.rows.back().errors;
    if (const auto omissions = omissions_of(study.rows, runs, before)) study.omissions = omissions;
    before = std::move(runs);
  }
  if (study.closed_form) study.reference_errors.bonded_forces = {};
  study.complete = !bench.stopped();
  study.cheapest = cheapest_settings(study);
  return study;
}

}  // namespace havers::sim
