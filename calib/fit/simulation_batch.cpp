// Scenes in normal form have keys; what neither memory nor store has of these is simulated in
// parallel, and rescaled to the scenes asked for (F3).
#include "calib/fit/simulation_batch.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <map>
#include <unordered_set>
#include <utility>

#include "calib/fit/normal_form.hpp"

namespace havers::calib {
namespace {

// Answers with unusable numbers have failed; the fit goes on without them. A modulus of 0 is one
// that is not known.
std::optional<Response> run_checked(const Simulator& simulator, const sim::Scene& scene) {
  std::optional<Response> answer = simulator.run(scene);
  if (!answer) return answer;
  Response& response = *answer;
  const auto usable = [](double x) { return x > 0.0 && x < 1e30; };
  const bool modulus = response.modulus == 0.0 || usable(response.modulus);
  if (!response.failed &&
      !(modulus && usable(response.strength) && usable(response.failure_strain))) {
    response.failed = true;
    response.why = "modulus, strength or failure strain is not a positive number";
  }
  return answer;
}

NormalForm form_of(const Simulator& simulator, const sim::Scene& scene) {
  return normal_form(scene, simulator.quasi_static(scene));
}

}  // namespace

// One key to be answered; `scene` is in normal form, and kept by the caller.
struct SimulationBatch::Work {
  std::string key;
  const sim::Scene* scene = nullptr;
  std::optional<Response> response{};
  bool simulated = false;
};

SimulationBatch::SimulationBatch(Simulator simulator, EvaluationStore* store, int threads)
    : simulator_(std::move(simulator)), store_(store), threads_(threads) {}

void SimulationBatch::settle(std::vector<Work>& work) {
  // Each task writes its own work alone. An exception of the store is no fault of a simulation, and
  // goes on to the caller.
  const auto settle_one = [&](std::size_t i) {
    auto& [key, scene, response, simulated] = work[i];
    if (stopped_) return;
    if (store_) response = store_->find(key);
    if (response) return;
    try {
      response = run_checked(simulator_, *scene);
    } catch (const std::exception& error) {  // which may not come again: for this fit only
      response = Response{.why = error.what()};
      simulated = true;
      return;
    }
    simulated = response.has_value();
    if (!simulated) stopped_ = true;
    if (store_ && simulated) store_->save(key, *response);
  };
  tbb::task_arena arena(threads_ > 0 ? threads_ : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, work.size(), settle_one); });
}

std::vector<Response> SimulationBatch::run(const std::vector<sim::Scene>& scenes) {
  std::vector<NormalForm> forms;
  std::vector<std::string> keys;
  forms.reserve(scenes.size());
  for (const auto& scene : scenes) {
    forms.push_back(form_of(simulator_, scene));
    keys.push_back(key_of(forms.back().scene));
    scaled_ |= forms.back().scaled;
  }

  // Each key once, in the order in which it is first asked for.
  std::vector<Work> missing;
  std::unordered_set<std::string> seen;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (!memory_.contains(keys[i]) && seen.insert(keys[i]).second)
      missing.push_back({.key = keys[i], .scene = &forms[i].scene});
  settle(missing);

  asked_ += static_cast<long>(scenes.size());
  // By the caller's thread, in order: counts and memory are the same for any number of threads.
  for (auto& [key, scene, response, simulated] : missing) {
    if (!response) continue;  // stopped: neither kept nor counted
    simulated_ += simulated ? 1 : 0;
    failed_ += response->failed ? 1 : 0;
    memory_.emplace(std::move(key), std::move(*response));
  }
  std::vector<Response> answers;
  answers.reserve(scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto found = memory_.find(keys[i]);
    answers.push_back(found == memory_.end() ? Response{.why = "stopped before it was simulated"}
                                             : rescaled(found->second, forms[i]));
  }
  return answers;
}

long SimulationBatch::reserved() const {
  return std::ranges::count_if(
      memory_, [](const auto& kept) { return !kept.second.failed && !kept.second.why.empty(); });
}

std::string SimulationBatch::most_frequent_why(bool failed) const {
  std::map<std::string, long> reasons;
  for (const auto& [key, response] : memory_)
    if (response.failed == failed && !response.why.empty()) ++reasons[response.why];
  const auto most =
      std::ranges::max_element(reasons, {}, [](const auto& one) { return one.second; });
  return most == reasons.end() ? "" : most->first;
}

std::vector<std::string> SimulationBatch::keys(const std::vector<sim::Scene>& scenes) const {
  std::vector<std::string> keys;
  keys.reserve(scenes.size());
  for (const auto& scene : scenes) keys.push_back(key_of(form_of(simulator_, scene).scene));
  return keys;
}

}  // namespace havers::calib
