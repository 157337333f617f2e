#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include "calib/fit/normal_form.hpp"
#include "calib/fit/simulation_batch.hpp"
#include "calib/study/parameter.hpp"
#include "calib/sweep/sweep.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {
namespace {

// Simulations between two looks at the observer.
constexpr std::size_t chunk = 32;

// The fibre model, which also keeps the pattern of every scene's broken joints in a map, by the key
// of the scene as the batch runs it. A store holds no patterns, so these runs cannot use one. `run`
// is called from several threads.
class PatternedModel {
 public:
  explicit PatternedModel(sim::StopAsked stop_asked) : stop_asked_(std::move(stop_asked)) {}

  Simulator simulator() {
    return {.run = [this](const sim::Scene& scene) { return run(scene); },
            .quasi_static = fibre_model().quasi_static};
  }
  // None of a run that broke where the response does not: that is cut at its strain limit (F3), and
  // what broke beyond is no part of it.
  [[nodiscard]] const Pattern* find(const std::string& key, bool broke) const {
    const auto found = patterns_.find(key);
    return found == patterns_.end() || found->second.broke != broke ? nullptr
                                                                    : &found->second.pattern;
  }

 private:
  std::optional<Response> run(const sim::Scene& scene) {
    const sim::Simulation simulation = sim::simulate(scene, {}, stop_asked_);
    std::optional<Response> response = response_of(simulation);
    if (!response || response->failed) return response;  // its joints may be none
    // The assembly is built once more, as a simulation does not hand it out.
    const Pattern pattern =
        pattern_of(sim::build_assembly(scene.assembly, scene.loading.lateral), simulation.joints);
    const std::scoped_lock lock(mutex_);
    patterns_[key_of(scene)] = {pattern, response->broke};
    return response;
  }

  struct Kept {
    Pattern pattern;
    bool broke = false;
  };

  sim::StopAsked stop_asked_;
  std::mutex mutex_;
  std::map<std::string, Kept> patterns_;
};

// Runs levels of points, as long as the observer wants to.
class Runner {
 public:
  Runner(const Sweep& sweep, EvaluationStore* store, int threads, const SweepObserver& observer,
         const sim::StopAsked& stop_asked)
      : sweep_(sweep),
        observer_(observer),
        model_(stop_asked),
        batch_(sweep.patterns ? model_.simulator() : fibre_model(stop_asked),
               sweep.patterns ? nullptr : store, threads),
        seeds_(static_cast<std::size_t>(sweep.plan.seeds)) {}

  // The runs of the points from `first` on.
  void run(SweepResult& result, std::size_t first) {
    std::vector<sim::Scene> scenes;
    for (std::size_t point = first; point < result.points.size(); ++point)
      // Seeds count on over all points, so that the runs of two points are independent (W3).
      for (std::size_t k = 0; k < seeds_; ++k) {
        scenes.push_back(result.points[point].scene);
        scenes.back().joints.seed = sweep_.plan.seed + point * seeds_ + k;
        result.runs.push_back({.point = point, .seed = scenes.back().joints.seed, .why = {}});
      }
    const std::size_t offset = first * seeds_;
    // In parts, between which the observer can stop; what has run stays.
    for (std::size_t at = 0; at < scenes.size() && !result.cancelled; at += chunk) {
      const std::size_t end = std::min(at + chunk, scenes.size());
      const std::vector<sim::Scene> some(scenes.begin() + static_cast<std::ptrdiff_t>(at),
                                         scenes.begin() + static_cast<std::ptrdiff_t>(end));
      const std::vector<Response> responses = batch_.run(some);
      result.cancelled = batch_.stopped();
      // Scenes that were not run are answered as failed, so none of this part is kept.
      if (result.cancelled) break;
      const std::vector<std::string> keys = batch_.keys(some);
      for (std::size_t i = 0; i < some.size(); ++i)
        keep(responses[i], some[i], keys[i], result.runs[offset + at + i]);
      result.cancelled = observer_ && !observer_(offset + end, result.points.size() * seeds_);
    }
    result.simulated = batch_.simulated();
    result.failed = batch_.failed();
    result.most_failed_because = batch_.most_failed_because();
    result.most_reserved_because = batch_.most_reserved_because();
  }

 private:
  // Keeps what a response says of a run; the curve only for a point's first run that did not fail.
  void keep(const Response& response, const sim::Scene& scene, const std::string& key,
            SweepRun& run) {
    run.failed = response.failed;
    run.broke = response.broke;
    run.why = response.why;
    run.measures =
        measures_of(response, scene, sweep_.patterns ? model_.find(key, run.broke) : nullptr);
    if (run.failed || run.point < next_curve_) return;
    next_curve_ = run.point + 1;
    run.strain = response.strain;
    run.stress = response.stress;
  }

  const Sweep& sweep_;
  const SweepObserver& observer_;
  PatternedModel model_;
  SimulationBatch batch_;
  std::size_t seeds_;
  std::size_t next_curve_ = 0;  // the first point that has none yet: runs come in their order
};

void summarise(SweepResult& result, std::size_t first) {
  for (std::size_t point = first; point < result.points.size(); ++point) {
    const PointSummary& summary = result.summaries.emplace_back(summary_of(result.runs, point));
    result.strengths.push_back(
        summary.unbroken > 0 ? StrengthLaw{}
                             : strength_law(values_of(result.runs, point, Measure::strength)));
  }
}

// Adds a point of the next level for every point from `first` on whose strength is known: two runs
// or more tell it, and none ended unbroken.
void climb(SweepResult& result, std::size_t first) {
  const std::size_t end = result.points.size();
  for (std::size_t point = first; point < end; ++point) {
    // A copy: the vector grows below.
    SweepPoint above = result.points[point];
    const PointSummary& summary = result.summaries[point];
    if (summary[Measure::strength].n < 2 || summary.unbroken > 0) continue;
    above.scene = scale_above(above.scene, summary);
    above.inertia_number = inertia_of(above.scene);
    ++above.level;
    result.points.push_back(std::move(above));
  }
}

}  // namespace

void SweepTotals::add(const SweepResult& result) {
  trusted = trusted && result.trusted();
  runs += static_cast<long>(result.runs.size());
  simulated += result.simulated;
  for (const PointSummary& summary : result.summaries) {
    failed += summary.failed;
    unbroken += summary.unbroken;
    reserved += summary.reserved;
  }
}

bool SweepResult::trusted() const {
  long without_strength = 0;
  for (const PointSummary& summary : summaries)
    without_strength += summary.failed + summary.unbroken;
  // In integers: a twentieth exactly is still trusted.
  return 20 * without_strength <= static_cast<long>(runs.size());
}

std::vector<Measure> SweepResult::known() const {
  std::vector<Measure> told;
  std::ranges::copy_if(all_measures, std::back_inserter(told), [this](Measure m) {
    return std::ranges::any_of(summaries, [m](const PointSummary& s) { return s[m].n > 0; });
  });
  return told;
}

sim::Scene scale_above(const sim::Scene& scene, const PointSummary& below) {
  const Statistics& strength = below[Measure::strength];
  sim::Scene above = scene;
  apply(above, "head_tail_MPa", strength.mean / 1e6);
  above.joints.distribution = sim::Distribution::weibull;
  // (W7) d = √12 times the coefficient of variation, held below 2.
  above.joints.scatter = std::min(strength.sd / strength.mean * std::sqrt(12.0), 1.99);
  return above;
}

SweepResult run_sweep(const Sweep& sweep, EvaluationStore* store, int threads,
                      const SweepObserver& observer, const sim::StopAsked& stop_asked) {
  SweepResult result;
  result.points = sweep.points;
  Runner runner(sweep, store, threads, observer, stop_asked);
  // Points of a level follow those of the level below; `first` is the first of the level that runs.
  std::size_t first = 0;
  for (int level = 1; level <= sweep.levels && !result.cancelled; ++level) {
    if (level > 1) {
      const std::size_t end = result.points.size();
      climb(result, first);
      first = end;
    }
    runner.run(result, first);
    if (!result.cancelled) summarise(result, first);
  }
  // From a part of the runs laws and claims could come out differently.
  if (result.cancelled) return result;
  for (const LawRequest& request : sweep.laws)
    for (Law& law : fit_laws(request, sweep.plan, result.points, result.runs))
      result.laws.push_back(std::move(law));
  for (const FindingRequest& request : sweep.findings)
    for (Finding& finding : judge(request, sweep.plan, result.points, result.runs))
      result.findings.push_back(std::move(finding));
  return result;
}

}  // namespace havers::calib
