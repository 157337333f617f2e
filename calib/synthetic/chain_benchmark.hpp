// Which chain of optimisers finds known truths best: parameter error against simulations and time.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "calib/study/study.hpp"

namespace havers::calib {

/// A chain of optimisers, by the options that choose it.
struct Chain {
  std::string name;
  GlobalSearch global = GlobalSearch::starts;
  LocalSearch local = LocalSearch::automatic;
  bool smooth = true;
};

/// The default chain first, then every other.
std::vector<Chain> all_chains();

/// One study fitted by one chain.
struct ChainRow {
  std::string chain;
  int study = 0;
  double error = 0.0;  ///< Root mean square of log(value/truth) over the informed parameters. [-]
  double cost = 0.0;   ///< ½ Σ residual² at the answer. [-]
  int informed = 0;    ///< Parameters with an interval, of three.
  long simulations = 0;
  double seconds = 0.0;  ///< Wall time. [s]
  bool success = false;  ///< Converged, cost within ½ of the best chain's for this study.
};

/// Rows of one chain: median, and 10 to 90 % as its ends.
struct ChainSummary {
  std::string chain;
  std::array<double, 3> error{}, simulations{}, seconds{};
  double success = 0.0;                ///< Part of the studies. [-]
  std::array<double, 2> success_95{};  ///< Wilson's interval. [-]
};

struct ChainBenchmark {
  std::vector<ChainRow> rows;
  std::vector<ChainSummary> summaries;
};

/// A study of six specimens at 0°, 45° and 90°, made by the model with the noise of a laboratory;
/// its truth is drawn by `number`, and returned in `truth` (young_GPa, head_tail_MPa, ratio).
Study known_study(int number, std::array<double, 3>& truth);

/// Fits `studies` known studies by every chain. `go_on` is asked before every fit; false ends.
ChainBenchmark benchmark_chains(int studies, int threads, const std::function<bool()>& go_on);

}  // namespace havers::calib
