// What a computation takes.
#pragma once

#include <chrono>
#include <ctime>

namespace havers::sim {

/// Runs from when it is made. CPU time is that of the process, so that runs side by side count each
/// other's time too.
class Stopwatch {
 public:
  [[nodiscard]] double wall_seconds() const {  ///< [s]
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }
  [[nodiscard]] double cpu_seconds() const {  ///< Of all threads. [s]
    return static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

}  // namespace havers::sim
