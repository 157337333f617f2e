// How the contact of an event is solved: from the answer before it, or from nothing.
#include <algorithm>
#include <utility>

#include "sim/contact/homotopy.hpp"
#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {
namespace {

// A tolerance below what rounding leaves is no reason to do without contact.
constexpr double least_tolerance = 1e-8;

}  // namespace

// What keeps the law to the tolerance, found in another way if need be; not converged where none
// does.
LocalContactResult BreakingRun::or_better(LocalContactResult result) {
  double residual = law_residual_of(contact_, result.y);
  if (!result.converged || !(residual <= scene_.solver.tolerance)) {
    LocalContactResult other = solve_local_contact(
        contact_, result.states, care_ == Care::little ? Effort::little : Effort::all);
    iterations_ += other.iterations;
    const double of_other = law_residual_of(contact_, other.y);
    if (!result.converged || (other.converged && of_other < residual)) {
      result = std::move(other);
      residual = of_other;
    }
  }
  result.converged =
      result.converged && residual <= std::max(scene_.solver.tolerance, least_tolerance);
  return result;
}

// From a solution that the joints just broken are still held in.
LocalContactResult BreakingRun::release(const StateSolution& known) {
  constexpr int most_changes = 5;  // paths that arrive take fewer, but for a few
  const std::vector<JointState> start = system_.states();
  LocalContactResult result;
  for (const double nothing : {1e-8, 1e-10, 1e-6}) {
    system_.set(start);
    const int spent = result.iterations;
    result = follow_homotopy(system_, {.cohesion = extra_}, known, most_changes, nothing);
    const bool was_long = 4 * result.iterations > static_cast<int>(loose_.size());
    result.iterations += spent;
    if (result.converged || was_long) break;
  }
  if (!result.converged) result.states = start;  // an answer is nearer to them than to a lost path
  return result;
}

}  // namespace havers::sim
