#include <algorithm>
#include <nlopt.hpp>

#include "calib/fit/search.hpp"

namespace havers::calib {
namespace {

// Where the simulations of a point failed: finite, because NLopt's models are built on numbers.
constexpr double cost_of_failure = 1e30;
// A change of ½χ² that no test could tell; of a wide search's coarser one even less.
constexpr double polish_cost_tolerance = 1e-3, wide_cost_tolerance = 2e-2;
constexpr int max_points = 200, max_polish_points = 12;  // the latter for each unknown

struct Objective {
  Trail& trail;
  const Split& split;
  nlopt::opt& optimiser;
  Evaluation best;
  int points = 0;

  double operator()(const std::vector<double>& values) {
    if (trail.stopped()) optimiser.force_stop();
    Point point = best.point;
    for (std::size_t i = 0; i < values.size(); ++i) point[split.costly[i]] = values[i];
    auto here = trail.evaluate(inside_bounds(trail.problem().unknowns, point));
    if (!here.failed && !split.free.empty()) here = search_ceres(trail, here, split.free).best;
    ++points;
    if (here.cost < best.cost) best = here;
    return here.failed ? cost_of_failure : std::min(here.cost, cost_of_failure);
  }

  static double call(const std::vector<double>& values, std::vector<double>& /*gradient*/,
                     void* self) {
    return (*static_cast<Objective*>(self))(values);
  }
};

std::string run(nlopt::opt& optimiser, std::vector<double> values) {
  double cost = 0.0;
  try {
    const auto outcome = optimiser.optimize(values, cost);
    return outcome == nlopt::MAXEVAL_REACHED ? "points exhausted" : "converged";
  } catch (const nlopt::forced_stop&) {
    return "stopped";
  } catch (const nlopt::roundoff_limited&) {
    return "converged to rounding";
  } catch (const std::exception& error) {
    return error.what();
  }
}

void set_box(nlopt::opt& optimiser, const std::vector<Unknown>& unknowns, const Active& costly,
             Stride stride) {
  std::vector<double> lower, upper, step;
  for (const Eigen::Index k : costly) {
    const auto& unknown = unknowns[static_cast<std::size_t>(k)];
    lower.push_back(unknown.lower);
    upper.push_back(unknown.upper);
    step.push_back(stride == Stride::wide ? unknown.range() / 8.0 : 0.02);
  }
  optimiser.set_lower_bounds(lower);
  optimiser.set_upper_bounds(upper);
  optimiser.set_initial_step(step);
}

}  // namespace

Split split_by_cost(const FitProblem& problem, const SimulationBatch& batch, const Point& at,
                    const Active& active) {
  const auto keys = [&](const Point& point) {
    std::vector<std::string> all;
    for (const std::size_t s : problem.fitted)
      std::ranges::move(batch.keys(replicate_scenes(problem, point, s, 1)),
                        std::back_inserter(all));
    return all;
  };
  const auto here = keys(at);
  Split split;
  for (const Eigen::Index k : active) {
    const auto& unknown = problem.unknowns[static_cast<std::size_t>(k)];
    Point moved = at;
    moved[k] += (at[k] < 0.5 * (unknown.lower + unknown.upper) ? 0.1 : -0.1) * unknown.range();
    (keys(moved) == here ? split.free : split.costly).push_back(k);
  }
  return split;
}

SearchResult search_nlopt(Trail& trail, const Evaluation& start, const Split& split,
                          Stride stride) {
  const bool quadratic = split.costly.size() > 1 && stride == Stride::wide;
  SearchResult result{.best = start};
  result.log = {.optimiser = quadratic ? "NLopt BOBYQA" : "NLopt Sbplx", .cost_before = start.cost};
  const int points_before = trail.points();
  const double seconds_before = trail.wall_seconds();
  if (split.costly.empty()) return result;

  nlopt::opt optimiser(quadratic ? nlopt::LN_BOBYQA : nlopt::LN_SBPLX,
                       static_cast<unsigned>(split.costly.size()));
  Objective objective{.trail = trail, .split = split, .optimiser = optimiser, .best = start};
  optimiser.set_min_objective(Objective::call, &objective);
  set_box(optimiser, trail.problem().unknowns, split.costly, stride);
  // Of the logarithm of a parameter; what a wide search leaves, least squares and polish find.
  optimiser.set_xtol_abs(stride == Stride::wide ? 2e-2 : 2e-3);
  optimiser.set_ftol_abs(stride == Stride::wide ? wide_cost_tolerance : polish_cost_tolerance);
  optimiser.set_maxeval(stride == Stride::wide
                            ? max_points
                            : max_polish_points * static_cast<int>(split.costly.size()));
  std::vector<double> values;
  for (const Eigen::Index k : split.costly) values.push_back(start.point[k]);

  result.log.message = run(optimiser, values);
  result.best = objective.best;
  result.log.cost_after = result.best.cost;
  result.log.evaluations = trail.points() - points_before;
  result.log.wall_seconds = trail.wall_seconds() - seconds_before;
  return result;
}

}  // namespace havers::calib
