// Starts are spread, and NLopt searches, over the costly unknowns only; at each point the free ones
// are solved for, which takes no new simulation (F3). Where all are free, they take the place of
// the costly ones.
#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <memory>

#include "calib/fit/search.hpp"

namespace havers::calib {
namespace {

constexpr int spread_starts = 7;  // beside the study's own
constexpr std::size_t refined_starts = 2;

// The study's own start, then a Halton sequence over the box of the unknowns that move.
std::vector<Point> starts_of(const FitProblem& problem, const Point& own, const Active& moving) {
  std::vector<Point> starts{own};
  const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> sequence(
      gsl_qrng_alloc(gsl_qrng_halton, static_cast<unsigned>(moving.size())), gsl_qrng_free);
  std::vector<double> fractions(moving.size());
  for (int i = 0; i < spread_starts; ++i) {
    gsl_qrng_get(sequence.get(), fractions.data());
    Point point = own;
    for (std::size_t j = 0; j < moving.size(); ++j) {
      const auto& unknown = problem.unknown(moving[j]);
      point[moving[j]] = unknown.lower + fractions[j] * unknown.range();
    }
    starts.push_back(point);
  }
  return starts;
}

}  // namespace

MultiStart search_globally(Trail& trail, const Active& active) {
  const Point own = trail.best().point;
  const auto split = split_by_cost(trail.problem(), trail.batch(), own, active);
  const bool all_free = split.costly.empty();
  trail.enter("starts");
  auto starts =
      trail.evaluate(starts_of(trail.problem(), own, all_free ? split.free : split.costly));
  for (auto& start : starts)
    if (!all_free) start = search_ceres(trail, start, split.free).best;
  std::ranges::stable_sort(starts, {}, &Evaluation::cost);
  std::erase_if(starts, &Evaluation::failed);
  MultiStart result;
  if (trail.problem().study.calibrate.global != GlobalSearch::starts && !starts.empty()) {
    trail.enter("global search");
    // Where all unknowns are free there is nothing else to search over.
    auto found = search_nlopt_globally(trail, starts.front(),
                                       all_free ? Split{.costly = split.free, .free = {}} : split);
    result.logs.push_back(found.log);
    // It began at the best start, is no worse, and takes its place: beside it that start would be
    // refined twice.
    starts.front() = std::move(found.best);
  }
  for (const auto& start : starts) result.starts.push_back(start.cost);
  starts.resize(std::min(starts.size(), refined_starts));

  for (const auto& start : starts) {
    trail.enter("search");
    auto end = all_free ? search_ceres(trail, start, split.free)
                        : search_nlopt(trail, start, split, Stride::wide);
    result.logs.push_back(end.log);
    // The derivative-free search stops in the valley, not at its bottom.
    if (!all_free && trail.problem().study.calibrate.smooth) {
      end = search_ceres(trail, end.best, active);
      result.logs.push_back(end.log);
    }
    result.ends.push_back(std::move(end.best));
  }
  std::ranges::stable_sort(result.ends, {}, &Evaluation::cost);
  return result;
}

}  // namespace havers::calib
