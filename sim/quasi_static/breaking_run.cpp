#include "sim/quasi_static/breaking_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/contact/homotopy.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Answers are refined until the loose joints' own problem lacks no more than this part of the
// reactions.
constexpr double refined = 1e-11;
constexpr int most_refinements = 5;
constexpr double most_growth = 10.0;  // of what is lacking: more, and rounding leads a piece away
constexpr double little = 1e-5;       // of the gaps: what so much changes is known to enough digits

// Of the intact specimen's force: where nothing bears any, where rounding may be all that is left,
// and more than what is broken can bear.
constexpr double nothing_borne = 1e-9, next_to_nothing = 1e-3, too_much = 2.0;
constexpr double hardly_stored = 1e-3;  // of the work of a force: then the force is rounding

// The law of a broken joint in the search for the next one: it never meets its cone.
constexpr JointLaw unbreakable{std::numeric_limits<double>::infinity(), 1.0};

}  // namespace

BreakingRun::BreakingRun(const Scene& scene, std::shared_ptr<const IntactStructure> intact,
                         Care care, const StopAsked& stop_asked)
    : scene_(scene),
      care_(care),
      glances_(care != Care::digits && scene.solver.leave_out),
      intact_(std::move(intact)),
      joints_(initial_outcomes(draw_thresholds(scene, intact_->assembly()))),
      loose_(intact_->structure(), [this](int joint) { return intact_->jump(joint); }),
      reference_{{}, intact_->answer().reactions, intact_->answer().force, 0.0},
      reactions_(reference_.reactions),
      force_(reference_.force),
      noise_(1e-10 * intact_->answer().reactions.lpNorm<Eigen::Infinity>()) {
  laws_.reserve(joints_.size());
  for (const JointOutcome& joint : joints_)
    laws_.push_back(joint.broken ? unbreakable : intact_law(joint.threshold));
  const auto joints = static_cast<double>(std::max<std::size_t>(1, joints_.size()));
  contact_.force_scale = reactions_.norm() / std::sqrt(joints);
  contact_.stop_asked = stop_asked;
}

bool BreakingRun::take_missing() {
  std::vector<std::size_t> missing;
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (joints_[j].broken) missing.push_back(j);
  if (missing.empty()) return true;
  loosen(missing);
  return settle();
}

void BreakingRun::stretch(double strain) {
  if (strain <= strain_) return;
  dissipated_ -= 0.5 * scene_.material.young * joint_work_ * (strain * strain - strain_ * strain_);
  strain_ = strain;
}

bool BreakingRun::break_joints(const std::vector<std::size_t>& breaking) {
  take_note_of_penetration();
  for (const std::size_t j : breaking) {
    joints_[j].broken = true;
    laws_[j] = unbreakable;
    joints_[j].broken_at_strain = strain_;
    ++broken_;
  }
  const double stored = point().elastic;
  const VectorXd gaps_before = y_;
  loosen(breaking);
  const std::vector<JointState> states_before = system_.states();
  unsolved_ = !settle() && !settle_with_care(states_before, gaps_before);
  if (unsolved_) take_back(breaking, gaps_before);
  dissipated_ += stored - point().elastic;
  return !unsolved_;
}

// What no way solves has not happened: the joints hold again, as in the last row of the curve.
void BreakingRun::take_back(const std::vector<std::size_t>& breaking, const VectorXd& gaps_before) {
  for (const std::size_t j : breaking) {
    joints_[j].broken = false;
    laws_[j] = intact_law(joints_[j].threshold);
    joints_[j].broken_at_strain = std::numeric_limits<double>::quiet_NaN();
    --broken_;
  }
  go_back_to(gaps_before);
  joint_work_ = borne_.dot(y_);
}

void BreakingRun::loosen(const std::vector<std::size_t>& breaking) {
  const JointLaw law = broken_law(scene_.joints.friction);
  const auto old = static_cast<Index>(loose_.size());
  const auto n = old + static_cast<Index>(breaking.size());
  // Columns help only while all loose joints have one, and while they are few.
  for (const std::size_t joint : breaking) {
    const bool none_missing = columns_.size() == loose_.size();
    loose_.add(static_cast<int>(joint));
    if (!glances_ || loose_.size() > intact_->columns_of_a_glance()) continue;
    auto column = intact_->column(loose_.jumps().back(), none_missing);
    if (none_missing && column) columns_.push_back(std::move(column));
  }
  contact_.laws.resize(loose_.size(), law);
  contact_.u0 = VectorXd::Zero(2 * n);
  contact_.S = loose_.stiffness();
  // A joint that comes loose has no gap yet, and bears what it bore.
  y_.conservativeResizeLike(contact_.u0);
  y_at_reference_.conservativeResizeLike(contact_.u0);
  y_seen_.conservativeResizeLike(contact_.u0);
  const VectorXd at_reference = reference_.reactions(loose_.rows());
  contact_.r0 = at_reference - contact_.S * y_at_reference_;
  const auto breaking_rows = Eigen::lastN(2 * (n - old));
  borne_.conservativeResize(2 * n);
  borne_(breaking_rows) =
      (at_reference + contact_.S * (y_ - y_at_reference_)).eval()(breaking_rows);
  extra_ = VectorXd::Zero(n);
  extra_.tail(n - old) =
      cohesion_to_stick(borne_(breaking_rows), std::vector<JointLaw>(breaking.size(), law));
  system_.grow();
}

// Once more from where nothing had given way; this answer and all after it are refined.
bool BreakingRun::settle_with_care(const std::vector<JointState>& states_before,
                                   const VectorXd& gaps_before) {
  if (care_ != Care::little || stop_is_asked(contact_.stop_asked)) return false;
  care_ = Care::digits;
  glances_ = false;
  system_.set(states_before);
  go_back_to(gaps_before);
  contact_.r0 = borne_ - contact_.S * y_;
  return settle();
}

void BreakingRun::go_back_to(const VectorXd& gaps_before) {
  y_.setZero(2 * static_cast<Index>(loose_.size()));
  y_.head(gaps_before.size()) = gaps_before;
  take_reference();
}

// Only what has just broken is released; the others follow from where they are.
bool BreakingRun::settle() {
  contact_.apart = apart();
  for (std::size_t i = 0; i < loose_.size(); ++i)
    if (contact_.is_apart(i) && system_.states()[i] != JointState::open)
      system_.set(i, JointState::open);
  // Nothing has moved yet, and nothing does before the first of those released gives way.
  StateSolution known{MatrixXd::Zero(contact_.r0.size(), 2), MatrixXd::Zero(contact_.r0.size(), 2)};
  known.y.col(0) = y_;
  known.r.col(0) = borne_;
  LocalContactResult result = release(known);
  iterations_ += result.iterations;
  result = or_better(std::move(result));
  if (!result.converged && (care_ == Care::little || stop_is_asked(contact_.stop_asked)))
    return false;
  if (!result.converged) {  // an answer without contact, counted and reported, instead of none
    ++without_contact_;
    contact_.apart.assign(loose_.size(), 1);
    result =
        solve_local_contact(contact_, std::vector<JointState>(loose_.size(), JointState::open));
  }
  system_.set(result.states);
  y_ = result.y;
  follow_gaps();
  const double intact_force = intact_->answer().force;
  const bool hardly_bears = std::abs(force_) <= next_to_nothing * intact_force;
  const bool in_two = hardly_bears && severed();
  // Where rounding may count, it is looked at by the answer of the whole structure.
  if (may_lose_digits() || hardly_bears) {
    see_all();
    borne_ = reactions_(loose_.rows());
    summed_ = summed();
    lacked_ = lacking().norm();
    // Where a piece swings freely, its gaps change so much that digits are lost.
    if (care_ == Care::digits || (hardly_bears && !in_two) ||
        lacked_ > refined * intact_->answer().reactions.norm())
      refine();
  }
  joint_work_ = borne_.dot(y_);
  worst_residual_ = worse(worst_residual_, law_missed(contact_, borne_, y_));
  if (in_two || (hardly_bears && bears_nothing())) force_ = joint_work_ = 0.0;
  return result.converged && std::abs(force_) <= too_much * intact_force;
}

// Of a refined answer: work that is not stored is rounding.
bool BreakingRun::bears_nothing() const {
  const double work = 0.5 * std::abs(force_ * intact_->assembly().width + joint_work_);
  return std::abs(force_) <= nothing_borne * intact_->answer().force ||
         intact_->energy(reference_.displacements) <= hardly_stored * work;
}

// What rounding leaves in a sum grows with its terms. How much that is differs from structure to
// structure, and is looked at whenever they have grown. The first time it is more the less a joint
// feels of itself: of 666 first events that were not looked at none lacked 2e-12 of the reactions.
bool BreakingRun::may_lose_digits() const {
  constexpr double grown = 100.0, near = 0.3, at_first = 1e-13;
  if (!glances_) return true;
  const double summed = this->summed();
  const double may_lack = near * refined * intact_->answer().reactions.norm();
  if (summed_ == 0.0) return !(at_first * summed <= may_lack * contact_.S.diagonal().minCoeff());
  return summed > grown * summed_ || lacked_ * summed > may_lack * summed_;
}

double BreakingRun::summed() const {
  return (contact_.S.cwiseAbs() * y_.cwiseAbs()).norm();
}

// What the gaps change is reckoned from the reference.
void BreakingRun::follow_gaps() {
  // By reciprocity the force at the end changes by r⁰·y/W, r⁰ being those of the intact structure.
  force_ = reference_.force + intact_->answer().reactions(loose_.rows()).dot(y_ - y_at_reference_) /
                                  intact_->assembly().width;
  borne_ = contact_.r0 + contact_.S * y_;
}

void BreakingRun::see_all() {
  reactions_ = all_reactions();
  y_seen_ = y_;
}

// The whole structure with the gaps.
void BreakingRun::take_reference() {
  reference_ = intact_->stretch(gaps(y_));
  y_at_reference_ = y_;
  reactions_ = reference_.reactions;
  y_seen_ = y_;
  borne_ = reactions_(loose_.rows());
  force_ = reference_.force;
}

VectorXd BreakingRun::all_reactions() const {
  if (y_seen_ == y_) return reactions_;
  return reference_.reactions +
         intact_->structure().reactions_to(loose_.jumps(), y_ - y_at_reference_);
}

// What the loose joints' own problem lacks of their reactions.
VectorXd BreakingRun::lacking() const {
  return reactions_(loose_.rows()) - (contact_.r0 + contact_.S * y_);
}

// Of all joints; loose ones that are beyond `of_loose` had not broken yet.
VectorXd BreakingRun::gaps(const VectorXd& of_loose) const {
  VectorXd gaps = VectorXd::Zero(2 * static_cast<Index>(joints_.size()));
  for (Index i = 0; i < of_loose.size(); ++i)
    gaps(loose_.rows()[static_cast<std::size_t>(i)]) = of_loose(i);
  return gaps;
}

// The whole structure with the gaps found. As long as it shows the joints other reactions than they
// solved for among themselves, these do so again.
void BreakingRun::refine() {
  const double scale = intact_->answer().reactions.norm();
  take_reference();
  VectorXd lack = lacking();
  for (int i = 0; i < most_refinements && lack.norm() > refined * scale; ++i) {
    // What the joints' own problem lacks is added to it, and it is solved again from the present
    // gaps.
    contact_.r0 += lack;
    const LocalContactResult found =
        or_better({.converged = true,
                   .y = answer_of_states(system_, {y_, contact_.r0 + contact_.S * y_}),
                   .states = system_.states()});
    if (!found.converged) break;
    const VectorXd y_before = std::exchange(y_, found.y);
    const double moved = (y_ - y_at_reference_).norm() * contact_.S.diagonal().maxCoeff();
    if (moved <= little * scale) {
      follow_gaps();
      see_all();
      borne_ = reactions_(loose_.rows());
    } else {
      take_reference();
    }
    VectorXd still_lacking = lacking();
    if (still_lacking.norm() > most_growth * lack.norm()) {
      y_ = y_before;
      contact_.r0 -= lack;
      take_reference();
      break;
    }
    system_.set(found.states);
    lack = std::move(still_lacking);
  }
}

}  // namespace havers::sim
