// Many simulations at once: the one place where a calibration asks for them.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "sim/simulation.hpp"

namespace havers::calib {

/// The model, as a calibration sees it. Both functions are called from several threads.
struct Simulator {
  std::function<std::optional<Response>(const sim::Scene&)> run;  ///< Nothing where it was stopped.
  std::function<bool(const sim::Scene&)> quasi_static;  ///< Whether (F3) holds for a scene.
};

/// havers' own simulator. All threads ask whether to stop.
Simulator fibre_model(const sim::StopAsked& stop_asked = {});

/// What is kept of a run of it: nothing where it was cancelled.
std::optional<Response> response_of(const sim::Simulation& run);

/// A simulator with a memory. The answers come in the order asked, the same for any number of
/// threads, and each simulation runs once, whoever asks and however often.
///
/// Once the simulator has stopped a run, no other begins. What was not simulated then is answered
/// as failed, but neither stored nor counted.
class SimulationBatch {
 public:
  /// @param store    remembers simulations between runs; null: none.
  /// @param threads  0: as many as the machine has.
  SimulationBatch(Simulator simulator, EvaluationStore* store, int threads);

  /// One response per scene, failed ones among them. Throws what the store throws. Not to be called
  /// from two threads at once.
  std::vector<Response> run(const std::vector<sim::Scene>& scenes);

  /// The keys of scenes, in normal form: equal keys, one simulation.
  [[nodiscard]] std::vector<std::string> keys(const std::vector<sim::Scene>& scenes) const;

  [[nodiscard]] long asked() const { return asked_; }          ///< Scenes, with repeats.
  [[nodiscard]] long simulated() const { return simulated_; }  ///< Run, and not found in the store.
  [[nodiscard]] long failed() const { return failed_; }        ///< Of the distinct ones.
  /// Why most of them failed; empty where none did.
  [[nodiscard]] std::string most_failed_because() const { return most_frequent_why(true); }
  [[nodiscard]] long reserved() const;  ///< Of the distinct ones: to be trusted but for something.
  /// What most of these are to be trusted but for; empty where there is nothing.
  [[nodiscard]] std::string most_reserved_because() const { return most_frequent_why(false); }
  /// Keys that were answered, by the store too: a budget counts these.
  [[nodiscard]] long distinct() const { return static_cast<long>(memory_.size()); }
  /// Whether scenes that differ in E and σ₁ alone were one simulation (F3).
  [[nodiscard]] bool scaled() const { return scaled_; }
  [[nodiscard]] bool stopped() const { return stopped_; }  ///< By the simulator.

 private:
  struct Work;
  void settle(std::vector<Work>& work);
  [[nodiscard]] std::string most_frequent_why(bool failed) const;

  Simulator simulator_;
  EvaluationStore* store_;  ///< Not owned; may be null.
  int threads_;
  std::unordered_map<std::string, Response> memory_;  ///< By key, in normal form.
  long asked_ = 0, simulated_ = 0, failed_ = 0;
  bool scaled_ = false;
  std::atomic<bool> stopped_ = false;  ///< Set and read by all threads.
};

}  // namespace havers::calib
