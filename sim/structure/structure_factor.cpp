// The factor of the mixed form (S7): its precision, and what is added to its diagonal to hold
// mechanisms.
#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double most_hold = 1e-9;  // of a mechanism, part of the largest stiffness
// Of a multiplier, by the largest compliance: 5e-3 and more in 2700 walls of up to 63 000 fibres,
// down to 1e-14 where slivers at angles of 1e-6 degrees nearly leave it no say, and below 2e-15
// where what it says follows from the others.
constexpr double least_pivot = 5e-15;
// Likewise of a mechanism, by the largest stiffness: rounding left 3e-16 to 1e-15 in columns of
// fibres that hang on each other by hinges.
constexpr double least_stiffness = 5e-15;
constexpr double least_in_single_precision = 1e-5;  // likewise
// Part of the stiffness that inertia is, below which single precision holds no loose body.
constexpr double least_inertia = 1e-5;

}  // namespace

// (S7): the mixed form with NᵀN added to Z, which changes nothing where Np = 0 and makes the block
// of the unknowns positive definite; an element for each body.
ElementMatrices Structure::mixed_form() const {
  ElementMatrices sum;
  sum.multipliers = static_cast<int>(bodies_->compatibilities());
  sum.size = static_cast<int>(layout_.unknowns) + sum.multipliers;
  for (const BodyClass& group : bodies_->classes()) {
    const Index ports = group.op.impedance.rows(), ring = group.op.compatibility.rows();
    if (ports == 0) continue;
    MatrixXd matrix = MatrixXd::Zero(ports + ring, ports + ring);
    matrix.topLeftCorner(ports, ports) = stiffened(group.op);
    matrix.bottomLeftCorner(ring, ports) = group.op.compatibility;
    matrix.topRightCorner(ports, ring) = group.op.compatibility.transpose();
    // By which rows of it each of its rows is: few of a class have other than their own.
    std::vector<std::pair<MatrixXd, int>> known{
        {MatrixXd(), static_cast<int>(sum.matrices.size())}};
    sum.matrices.push_back(matrix);
    for (const int body : group.bodies) {
      ElementMatrices::Element& element =
          sum.elements.emplace_back(ElementMatrices::Element{-1, sum.rows.size()});
      const MatrixXd into = add_rows(body, sum.rows);
      const auto same = std::ranges::find_if(known, [&](const auto& one) {
        return one.first.rows() == into.rows() && one.first == into;
      });
      if (same == known.end()) {
        element.matrix = static_cast<int>(sum.matrices.size());
        known.emplace_back(into, element.matrix);
        sum.matrices.emplace_back(into * matrix * into.transpose());
      } else {
        element.matrix = same->second;
      }
    }
  }
  return sum;
}

// The rows of a body's ports and multipliers, each once.
// @return which they are of all of these; empty: one of each, in order. Two ports have the same one
// where a tie leads from a body to itself, one has two where it is the top of a tie.
MatrixXd Structure::add_rows(int body, std::vector<int>& rows) const {
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index ports = op.impedance.rows(), ring = op.compatibility.rows();
  const auto first = std::ssize(rows);
  MatrixXd into = MatrixXd::Zero(ports + ring + 1, ports + ring);
  bool in_order = true;
  for (Index port = 0; port < ports; ++port)
    for (const int row : unknowns_of_port(bodies_->first_port(body) + port)) {
      const auto known = std::find(rows.begin() + first, rows.end(), row);
      const auto place = known - (rows.begin() + first);
      into(place, port) = 1.0;
      in_order = in_order && place == port;
      if (known == rows.end()) rows.push_back(row);
    }
  for (Index i = 0; i < ring; ++i) {
    into(std::ssize(rows) - first, ports + i) = 1.0;
    rows.push_back(static_cast<int>(first_multiplier(static_cast<std::size_t>(body)) + i));
  }
  if (in_order) return {};
  return into.topRows(std::ssize(rows) - first);
}

void Structure::hold(std::vector<Held> held, Precision precision) {
  layout_ = laid_out(std::move(held));
  factorised_ = layout_;
  find_loose_components();
  changes_.clear();
  factorise(precision);
}

// In the memory of the factor before, if there is one.
void Structure::factorise(Precision precision) {
  op_of_body_.resize(bodies_->assembly().bodies.size());
  for (const BodyClass& bodies : bodies_->classes()) {
    if (bodies.op.impedance.size() > 0)
      stiffness_ = std::max(stiffness_, bodies.op.impedance.diagonal().maxCoeff());
    for (const int body : bodies.bodies) op_of_body_[static_cast<std::size_t>(body)] = &bodies.op;
  }
  if (layout_.unknowns == 0) {
    factor_.reset();
    single_.reset();
    return;
  }
  const ElementMatrices sum = mixed_form();
  const Supervariables groups(sum);
  auto tree =
      std::make_shared<EliminationTree>(elimination_tree(sum, groups, elimination_order(groups)));
  // Where many joints are loose, hardly anything is like anything else.
  if (bodies_->shared() &&
      std::ranges::count(layout_.held, Held::fully) == std::ssize(layout_.held))
    share_values(*tree, sum);
  Pivots pivots{least_pivot / stiffness_, 0.0, least_stiffness * stiffness_};
  const bool slides = std::ranges::count(layout_.held, Held::normal) > 0;
  const bool has_inertia = std::ranges::all_of(bodies_->classes(), [](const BodyClass& group) {
    return group.op.inertia_part > least_inertia;
  });
  single_.reset();
  if (slides && has_inertia && precision == Precision::single_where_enough) {
    factor_.reset();
    single_.emplace(sum, tree, Pivots{least_in_single_precision / stiffness_, 0.0});
    if (single_->ok()) return;
    single_.reset();
  }
  // A mechanism has nothing but its trace of inertia. The factor may hold it, for the corrections
  // take what it adds away from everything that bears a load.
  const auto try_to = [&] {
    std::vector<double> memory;
    if (factor_) memory = std::move(*factor_).memory();
    factor_.emplace(sum, tree, pivots, std::move(memory));
    return factor_->ok();
  };
  for (double hold = 1e-13; !try_to() && hold < most_hold; hold *= 10.0)
    pivots.added += hold * stiffness_;
}

}  // namespace havers::sim
