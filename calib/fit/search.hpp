// The searches: each starts somewhere, moves some unknowns, and says where it got.
#pragma once

#include <vector>

#include "calib/fit/trail.hpp"

namespace havers::calib {

struct SearchResult {
  Evaluation best;  ///< Best of this search; failed if none of its points gave an answer.
  StageLog log{};
};

/// Least squares by Ceres' Levenberg-Marquardt with our own derivatives (F8).
SearchResult search_ceres(Trail& trail, const Evaluation& start, const Active& active);

/// Unknowns by what they cost: moving a free one asks for no new simulation (F3), moving a costly
/// one does. Found by the keys of scenes beside `at`: nothing is simulated.
struct Split {
  Active costly, free;
};
Split split_by_cost(const FitProblem& problem, const SimulationBatch& batch, const Point& at,
                    const Active& active);

/// Derivative-free minimisation by NLopt over the costly unknowns; at each point the free ones are
/// solved for by search_ceres. By the study's local method; Sbplx for `polish`, which begins with
/// small steps.
enum class Stride { wide, polish };
SearchResult search_nlopt(Trail& trail, const Evaluation& start, const Split& split, Stride stride);

/// The same over the whole bounds, by the study's global method. Precondition: it has one.
SearchResult search_nlopt_globally(Trail& trail, const Evaluation& start, const Split& split);

/// Starts spread over the bounds, the best of them refined; what each refined one came to, best
/// first.
struct MultiStart {
  std::vector<double> starts;  ///< Costs of all starts, lowest first.
  std::vector<Evaluation> ends;
  std::vector<StageLog> logs;
};
MultiStart search_globally(Trail& trail, const Active& active);

}  // namespace havers::calib
