// Which joints of a breaking specimen are the next to break.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Joints that meet their cones at strains closer than this break together, whatever their order.
constexpr double together = 1e-9;
constexpr double never = std::numeric_limits<double>::infinity();

constexpr double most_missed = 10.0;       // by a glance at some joint, times what it is seen to
constexpr std::size_t most_looked_at = 4;  // one by one: of more, all joints at once cost less

NearReactions sum_of(const std::vector<IntactStructure::SharedColumn>& columns,
                     const Eigen::VectorXf& gaps) {
  NearReactions sum{Eigen::VectorXf::Zero(columns.front()->reactions.rows())};
  Eigen::VectorXf off_balance(static_cast<Index>(columns.size()));  // by rounding, of each
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Eigen::Vector2f by = gaps.segment<2>(static_cast<Index>(2 * i));
    sum.reactions.noalias() += columns[i]->reactions.leftCols<2>() * by;
    off_balance(static_cast<Index>(i)) = columns[i]->off_balance * by.lpNorm<1>();
  }
  sum.off_balance = off_balance.norm();
  return sum;
}

}  // namespace

BreakingRun::Event BreakingRun::next_event() {
  if (force_ == 0.0) return {never, {}};  // what bears nothing breaks nothing: this is rounding
  if (y_seen_ != y_) {
    const auto [reactions, missed] = glance();
    std::vector<Candidate> candidates = may_be_next(reactions, most_missed * missed);
    if (missed < never && candidates.size() <= most_looked_at)
      return first_of(std::move(candidates));
    see_all();
  }
  return first_of(may_be_next(reactions_, 0.0));
}

// In single precision, from what was last seen of all.
BreakingRun::Glance BreakingRun::glance() const {
  const VectorXd moved = y_ - y_seen_;
  // Columns are added up where each loose joint has one.
  const NearReactions change = columns_.size() < loose_.size()
                                   ? intact_->nearly_reactions_to(loose_.jumps(), moved)
                                   : sum_of(columns_, moved.cast<float>());
  Glance found{reactions_ + change.reactions.cast<double>(), change.off_balance};
  // What single precision misses shows where the two sides of a joint differ, and at loose joints,
  // whose reactions are known (S8).
  found.missed =
      std::max(found.missed, (found.reactions(loose_.rows()) - borne_).lpNorm<Eigen::Infinity>());
  if (!found.reactions.allFinite()) found.missed = never;
  return found;
}

// Joints of which none is sure to break after another, where reactions may be missed by so much.
std::vector<BreakingRun::Candidate> BreakingRun::may_be_next(const VectorXd& reactions,
                                                             double missed) const {
  double last = never;  // strain at which one is sure to have broken
  std::vector<Candidate> candidates;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Local r = of_joint(reactions, j);
    // The strain at which it breaks: here the earliest, below the latest.
    const double may = meets_cone_at(j, {r.x() - missed, std::abs(r.y()) + missed});
    if (!(may < never) || may > last * (1.0 + together)) continue;
    candidates.push_back({may, j});
    last =
        std::min(last, meets_cone_at(j, {r.x() + missed, std::max(0.0, std::abs(r.y()) - missed)}));
  }
  std::erase_if(candidates,
                [&](const Candidate& one) { return one.strain > last * (1.0 + together); });
  return candidates;
}

// By what each bears to all digits, as long as it may still break before those looked at.
BreakingRun::Event BreakingRun::first_of(std::vector<Candidate> candidates) {
  std::ranges::sort(candidates, {}, &Candidate::strain);
  Event event{never, {}};
  const auto is_later = [&](const Candidate& one) {
    return one.strain > event.strain * (1.0 + together);
  };
  // In the order in which they may break, until none of the rest can break before one that is
  // known.
  auto next = candidates.begin();
  for (; next != candidates.end() && !is_later(*next); ++next) {
    next->strain = meets_cone_at(next->joint, borne_at(next->joint));
    event.strain = std::min(event.strain, next->strain);
  }
  for (const Candidate& one : std::span(candidates.begin(), next))
    if (!is_later(one)) event.joints.push_back(one.joint);
  std::ranges::sort(event.joints);
  return event;
}

// By the influence of the loose joints, one by one.
Local BreakingRun::borne_at(std::size_t joint) {
  Local borne = of_joint(reference_.reactions, joint);
  if (y_ != y_at_reference_)
    borne += loose_.reactions_of(static_cast<int>(joint)) * (y_ - y_at_reference_);
  return borne;
}

}  // namespace havers::sim
