// Many simulations at once: the one place where a calibration asks for them.
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "calib/fit/evaluation_store.hpp"
#include "sim/scene.hpp"

namespace havers::sim {
struct Simulation;
}

namespace havers::calib {

/// The model, as a calibration sees it. Both functions are called from several threads.
struct Simulator {
  std::function<Response(const sim::Scene&)> run;
  std::function<bool(const sim::Scene&)> quasi_static;  ///< Whether (F3) holds for a scene.
};

/// havers' own simulator.
Simulator fibre_model();

/// What is kept of a run of it.
Response response_of(const sim::Simulation& run);

/// A simulator with a memory. The answers come in the order asked, the same for any number of
/// threads, and each simulation runs once, whoever asks and however often.
class SimulationBatch {
 public:
  /// @param store    remembers simulations between runs; null: none.
  /// @param threads  0: as many as the machine has.
  SimulationBatch(Simulator simulator, EvaluationStore* store, int threads);

  std::vector<Response> run(const std::vector<sim::Scene>& scenes);

  /// The keys of scenes, in normal form: equal keys, one simulation.
  [[nodiscard]] std::vector<std::string> keys(const std::vector<sim::Scene>& scenes) const;

  [[nodiscard]] long asked() const { return asked_; }
  [[nodiscard]] long simulated() const { return simulated_; }
  [[nodiscard]] long failed() const { return failed_; }  ///< Of the distinct ones.
  [[nodiscard]] long distinct() const { return static_cast<long>(memory_.size()); }

 private:
  struct Work;
  void settle(std::vector<Work>& work);

  Simulator simulator_;
  EvaluationStore* store_;
  int threads_;
  std::unordered_map<std::string, Response> memory_;
  long asked_ = 0, simulated_ = 0, failed_ = 0;
};

}  // namespace havers::calib
