// Which chain of optimisers finds known truths best: parameter error against simulations and time.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "calib/synthetic/known_study.hpp"

namespace havers::calib {

/// A chain of optimisers, by the options that choose it.
struct Chain {
  std::string name;
  GlobalSearch global = GlobalSearch::starts;
  LocalSearch local = LocalSearch::automatic;
  bool smooth = true;
};

/// How many unknowns need new simulations when they move: the ratio, or ratio and scatter.
enum class CostlyUnknowns { one, two };

/// The default chain first, then every other.
std::vector<Chain> all_chains(CostlyUnknowns unknowns = CostlyUnknowns::one);

/// Where a fit was when it had cost so much.
struct TracePoint {
  long simulations = 0;
  double seconds = 0.0;  ///< Wall time. [s]
  double error = 0.0;    ///< Of the best point so far, as ChainRow::error. [-]
};

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
  std::vector<TracePoint> trace{};
};

/// Error of a chain's fits when each had cost so much: 10, 50 and 90 %.
struct Progress {
  double cost = 0.0;  ///< Simulations, or wall time. [-] or [s]
  std::array<double, 3> error{};
};

/// Rows of one chain: 10, 50 and 90 %.
struct ChainSummary {
  std::string chain;
  std::array<double, 3> error{}, simulations{}, seconds{};
  Rate success;
  std::vector<Progress> by_simulations{}, by_seconds{};
};

/// The fits of all chains, and their summaries.
struct ChainBenchmark {
  std::vector<ChainRow> rows;
  std::vector<ChainSummary> summaries;  ///< In the order of the rows; empty when stopped.

  /// The chains that succeed most often (all have the same studies), and whose 90 % error is
  /// within a tenth of the least of theirs.
  [[nodiscard]] std::vector<const ChainSummary*> contenders() const;

  /// Of the contenders the one with the fewest simulations (median). Precondition: there are
  /// summaries.
  [[nodiscard]] const ChainSummary& winner() const;
};

/// Fits `studies` known studies by every chain, one after the other on `threads` threads (0: all).
/// `go_on` is asked before every fit; false ends, with the rows so far and no summaries.
ChainBenchmark benchmark_chains(CostlyUnknowns unknowns, int studies, int threads,
                                const std::function<bool()>& go_on);

/// What the rows come to, chain by chain. Precondition: as many rows of each chain.
ChainBenchmark summarise(std::vector<ChainRow> rows);

}  // namespace havers::calib
