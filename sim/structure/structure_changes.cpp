// Joints that hold in another way than in the factor (S9).
#include <iterator>

#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t worth_a_factor = 50;  // changes, each of a path through it and a row with all

}  // namespace

bool Structure::hold_nearby(const std::vector<Held>& held) {
  if (!single_) return false;
  std::vector<int> changed;
  for (int joint = 0; joint < static_cast<int>(held.size()); ++joint)
    if (held[static_cast<std::size_t>(joint)] != factorised_.held[static_cast<std::size_t>(joint)])
      changed.push_back(joint);
  if (changed.size() > worth_a_factor) return false;

  layout_ = laid_out(held);
  find_loose_components();
  changes_.clear();
  std::vector<Index> first;  // of each, among the components of all
  Index size = 0;
  for (const int joint : changed) {
    changes_.push_back(change_of(joint));
    first.push_back(size);
    size += std::ssize(changes_.back().components);
  }
  // The matrix between jumps and forces that is left when all unknowns are eliminated: products of
  // paths, no solve.
  MatrixXd between(size, size);
  for (std::size_t i = 0; i < changes_.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const MatrixXd block = coupling(changes_[i], changes_[j]);
      between.block(first[i], first[j], block.rows(), block.cols()) = block;
      between.block(first[j], first[i], block.cols(), block.rows()) = block.transpose();
    }
  if (size > 0) between_changes_.compute(between);
  return true;
}

Structure::Change Structure::change_of(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  Change change{joint, layout_.held[j] < factorised_.held[j], {}, {}, {}};
  for (const int component : {0, 1})
    if (const int unknown = 2 * joint + component; holds(unknown, factorised_) != holds(unknown))
      change.components.push_back(static_cast<std::size_t>(component));
  if (change.holds_more) {
    // What holds again has forces on both sides, each on the path of its own side's unknowns.
    for (const std::size_t side : {0U, 1U}) {
      const auto row = [&](std::size_t component) {
        return unknowns_of_port(bodies_->ends()[2 * j + component][side])[0];
      };
      const double sign = side == 0 ? -1.0 : 1.0;
      change.halves.push_back(
          single_->eliminate({row(0), row(1)}, sign * Eigen::Matrix2d::Identity()));
    }
  } else {
    const auto [rows, load] = load_of_jump(joint);
    change.halves.push_back(single_->eliminate(rows, -load));  // a jump's, on the other side
  }
  for (const Eliminated& half : change.halves)
    change.over_pivots.push_back(single_->over_pivots(half));
  return change;
}

// Of the equations between changes that are left when all unknowns are eliminated.
MatrixXd Structure::coupling(const Change& of, const Change& to) const {
  Eigen::Matrix2d all = Eigen::Matrix2d::Zero();
  if (!of.holds_more && !to.holds_more) all = stiffness_between(of.joint, to.joint);
  for (const Eliminated& a : of.over_pivots)
    for (const Eliminated& b : to.halves) all -= product(a, b);
  return all(of.components, to.components);
}

void Structure::find_loose_components() {
  loose_components_.clear();
  for (int joint_unknown = 0; joint_unknown < 2 * static_cast<int>(joints()); ++joint_unknown) {
    if (holds(joint_unknown) && holds(joint_unknown, factorised_)) continue;
    const auto port =
        static_cast<std::size_t>(bodies_->ends()[static_cast<std::size_t>(joint_unknown)][1]);
    loose_components_.push_back(
        {joint_unknown, layout_.of_port[port][0], factorised_.of_port[port][0]});
  }
}

// What has let go bears no force, what holds has no jump.
VectorXd Structure::solve_nearby(const VectorXd& load) const {
  // Both layouts begin with joints and ties, and end with what ties have in common and the
  // multipliers; the loose sides in between differ.
  const Index shared = 2 * joints() + std::ssize(tops_of_ties_);
  const Index last = load.size() - layout_.unknowns + (tops_of_ties_.empty() ? 0 : 1);
  VectorXd in_factor(factorised_.unknowns + load.size() - layout_.unknowns);
  in_factor.head(shared) = load.head(shared);
  in_factor.tail(last) = load.tail(last);
  for (const auto& [joint_unknown, own, in_the_factor] : loose_components_)
    // Loose in the factor: its own row, without a load where it holds by now.
    if (in_the_factor != joint_unknown)
      in_factor(in_the_factor) = own == joint_unknown ? 0.0 : load(own);
    else
      // Held in the factor: both sides' loads are on one row.
      in_factor(joint_unknown) += load(own);
  // Single precision has but so many powers of ten.
  const double largest = in_factor.lpNorm<Eigen::Infinity>(), size = largest > 0.0 ? largest : 1.0;
  VectorXd half = single_->halve(in_factor / size).cast<double>();
  VectorXd by(between_changes_.rows());
  const auto for_each_change = [&](const auto& visit) {
    Index row = 0;
    for (const Change& change : changes_)
      for (const std::size_t component : change.components)
        visit(change, static_cast<Index>(component), row++,
              Index{layout_.of_port[static_cast<std::size_t>(port_b(change.joint, component))][0]});
  };
  // First the jumps and forces of the changes, from the half solve in their rows; then what they
  // change in it.
  if (is_corrected()) {
    for_each_change([&](const Change& change, Index component, Index row, Index own) {
      by(row) = change.holds_more ? 0.0 : load(own) / size;
      for (const auto& [rows, values] : change.over_pivots)
        by(row) -= values.row(component).dot(half(rows));
    });
    by = between_changes_.solve(by).eval();
    for_each_change([&](const Change& change, Index component, Index row, Index) {
      for (const auto& [rows, values] : change.halves)
        half(rows) -= by(row) * values.row(component).transpose();
    });
  }
  const VectorXd found = size * single_->complete(half).cast<double>();
  VectorXd answer(load.size());
  answer.head(shared) = found.head(shared);
  answer.tail(last) = found.tail(last);
  for (const auto& [joint_unknown, own, in_the_factor] : loose_components_)
    if (own != joint_unknown) answer(own) = found(in_the_factor);
  for_each_change([&](const Change& change, Index, Index row, Index own) {
    if (!change.holds_more) answer(own) += size * by(row);
  });
  return answer;
}

}  // namespace havers::sim
