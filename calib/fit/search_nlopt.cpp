// NLopt over the costly unknowns. It decides where to look next, and nothing else: costs come from
// the trail, which also keeps the best point, and a search that is to end is ended by force.
#include <algorithm>
#include <exception>
#include <nlopt.hpp>

#include "calib/fit/search.hpp"

namespace havers::calib {
namespace {

// Where the simulations of a point failed: finite, because NLopt's models are built on numbers.
constexpr double cost_of_failure = 1e30;
// A change of ½χ² that no test could tell; of a wide search's coarser one even less.
constexpr double polish_cost_tolerance = 1e-3, wide_cost_tolerance = 2e-2;
constexpr int max_points = 200;
constexpr int max_polish_points = 12, max_global_points = 40;  // for each unknown

struct Objective {
  Trail& trail;
  const Split& split;
  nlopt::opt& optimiser;
  Evaluation best;
  std::exception_ptr thrown{};  // NLopt would make a failure of its own of it

  double operator()(const std::vector<double>& values) {
    if (trail.stopped()) optimiser.force_stop();
    // The free unknowns begin where the best point so far has them.
    Point point = best.point;
    for (std::size_t i = 0; i < values.size(); ++i) point[split.costly[i]] = values[i];
    auto here = trail.evaluate(inside_bounds(trail.problem().unknowns, point));
    if (!here.failed && !split.free.empty()) here = search_ceres(trail, here, split.free).best;
    if (here.cost < best.cost) best = here;
    return here.failed ? cost_of_failure : std::min(here.cost, cost_of_failure);
  }

  static double call(const std::vector<double>& values, std::vector<double>& /*gradient*/,
                     void* self) {
    auto& objective = *static_cast<Objective*>(self);
    try {
      // After a failure NLopt may ask for more points before it ends: they are not evaluated.
      if (!objective.thrown) return objective(values);
    } catch (...) {
      objective.thrown = std::current_exception();
      objective.optimiser.force_stop();
    }
    return cost_of_failure;
  }
};

// How it ended, for the log: NLopt tells much of it by exceptions, and none is a reason to end the
// fit.
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

void set_box(nlopt::opt& optimiser, const FitProblem& problem, const Active& costly,
             Stride stride) {
  std::vector<double> lower, upper, step;
  for (const Eigen::Index k : costly) {
    const auto& unknown = problem.unknown(k);
    lower.push_back(unknown.lower);
    upper.push_back(unknown.upper);
    // In the scale of the search: for a polish 2 % of a parameter that is searched in its
    // logarithm.
    step.push_back(stride == Stride::wide ? unknown.range() / 8.0 : 0.02);
  }
  optimiser.set_lower_bounds(lower);
  optimiser.set_upper_bounds(upper);
  optimiser.set_initial_step(step);
}

/// One use of NLopt.
struct Plan {
  nlopt::algorithm algorithm;
  const char* name;
  Stride stride = Stride::wide;
  int max_points = 0;
};

Plan local_plan(LocalSearch local, std::size_t unknowns) {
  if (local == LocalSearch::automatic)
    local = unknowns > 1 ? LocalSearch::bobyqa : LocalSearch::cobyla;
  // BOBYQA cannot do with one unknown.
  if (local == LocalSearch::bobyqa && unknowns > 1) return {nlopt::LN_BOBYQA, "NLopt BOBYQA"};
  if (local == LocalSearch::cobyla) return {nlopt::LN_COBYLA, "NLopt COBYLA"};
  return {nlopt::LN_SBPLX, "NLopt Sbplx"};
}

Plan global_plan(GlobalSearch global) {
  switch (global) {
    case GlobalSearch::crs2:
      return {nlopt::GN_CRS2_LM, "NLopt CRS2"};
    case GlobalSearch::mlsl:
      return {nlopt::GN_MLSL_LDS, "NLopt MLSL"};
    case GlobalSearch::esch:
      return {nlopt::GN_ESCH, "NLopt ESCH"};
    // `starts` does not come here.
    case GlobalSearch::direct:
    case GlobalSearch::starts:
      break;
  }
  return {nlopt::GN_DIRECT_L, "NLopt DIRECT-L"};
}

SearchResult follow(const Plan& plan, Trail& trail, const Evaluation& start, const Split& split) {
  SearchResult result{.best = start};
  result.log = {.optimiser = plan.name, .cost_before = start.cost, .cost_after = start.cost};
  if (split.costly.empty()) return result;
  const int points_before = trail.points();
  const double seconds_before = trail.wall_seconds();

  const auto count = static_cast<unsigned>(split.costly.size());
  nlopt::opt optimiser(plan.algorithm, count);
  // MLSL refines what it samples by a local method, also one of NLopt's.
  if (plan.algorithm == nlopt::GN_MLSL_LDS) {
    nlopt::opt local(nlopt::LN_SBPLX, count);
    local.set_ftol_abs(wide_cost_tolerance);
    local.set_xtol_abs(2e-2);
    optimiser.set_local_optimizer(local);
  }
  Objective objective{.trail = trail, .split = split, .optimiser = optimiser, .best = start};
  optimiser.set_min_objective(Objective::call, &objective);
  set_box(optimiser, trail.problem(), split.costly, plan.stride);
  // Of the logarithm of a parameter; what a wide search leaves, least squares and polish find.
  const bool wide = plan.stride == Stride::wide;
  optimiser.set_xtol_abs(wide ? 2e-2 : 2e-3);
  optimiser.set_ftol_abs(wide ? wide_cost_tolerance : polish_cost_tolerance);
  optimiser.set_maxeval(plan.max_points);
  std::vector<double> values;
  for (const Eigen::Index k : split.costly) values.push_back(start.point[k]);

  result.log.message = run(optimiser, values);
  if (objective.thrown) std::rethrow_exception(objective.thrown);
  result.best = objective.best;
  result.log.cost_after = result.best.cost;
  result.log.evaluations = trail.points() - points_before;
  result.log.wall_seconds = trail.wall_seconds() - seconds_before;
  return result;
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
    const auto& unknown = problem.unknown(k);
    Point moved = at;
    // Moved by a tenth of the range, towards the farther bound.
    moved[k] += (at[k] < 0.5 * (unknown.lower + unknown.upper) ? 0.1 : -0.1) * unknown.range();
    (keys(moved) == here ? split.free : split.costly).push_back(k);
  }
  return split;
}

SearchResult search_nlopt(Trail& trail, const Evaluation& start, const Split& split,
                          Stride stride) {
  const auto count = split.costly.size();
  Plan plan = stride == Stride::polish ? Plan{nlopt::LN_SBPLX, "NLopt Sbplx"}
                                       : local_plan(trail.problem().study.calibrate.local, count);
  plan.stride = stride;
  plan.max_points =
      stride == Stride::wide ? max_points : max_polish_points * static_cast<int>(count);
  return follow(plan, trail, start, split);
}

SearchResult search_nlopt_globally(Trail& trail, const Evaluation& start, const Split& split) {
  const auto& options = trail.problem().study.calibrate;
  Plan plan = global_plan(options.global);
  plan.max_points = max_global_points * static_cast<int>(split.costly.size());
  // So that the same study takes the same path.
  nlopt::srand(static_cast<unsigned long>(options.seed));
  return follow(plan, trail, start, split);
}

}  // namespace havers::calib
