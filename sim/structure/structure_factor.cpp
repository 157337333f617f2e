#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "sim/structure/disjoint_sets.hpp"
#include "sim/structure/dissection.hpp"
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
constexpr double determined = 0.01;  // least share of a joint in multipliers to give them a pivot

// Whether each direction in a set of orthonormal rows has that share or more, where only some
// columns are looked at.
bool all_have(double share, const MatrixXd& rows) {
  MatrixXd beyond = rows * rows.transpose();
  beyond.diagonal().array() -= share;
  return beyond.llt().info() == Eigen::Success;
}

}  // namespace

// Where, in the order of elimination, a joint connects two bodies.
struct Structure::Branch {
  int place;
  std::size_t a, b;
};

// Of each body: whether every joint determines its multipliers, as of all of its class. All fibres
// of full size are so.
std::vector<char> Structure::conducting() const {
  std::vector<char> conducts(op_of_body_.size());
  for (const BodyClass& group : bodies_->classes()) {
    const MatrixXd& N = group.op.compatibility;
    const Index first = bodies_->first_port(group.bodies.front());
    bool all = true;
    // Two ports of each joint, then those of ties.
    for (Index i = 0; i < N.cols() && N.rows() > 0; i += 2) {
      if (bodies_->ports()[static_cast<std::size_t>(first + i)].unknown >= 2 * joints()) break;
      all = all && all_have(determined, N.middleCols<2>(i));
    }
    for (const int body : group.bodies) conducts[static_cast<std::size_t>(body)] = all ? 1 : 0;
  }
  return conducts;
}

// Joints by the place at which both of their unknowns are eliminated. A joint that holds nothing
// has unknowns of its own for each body, which connect it to what needs no multipliers.
std::vector<Structure::Branch> Structure::network(const std::vector<int>& place) const {
  const std::vector<char> conducts = conducting();
  const std::size_t ground = op_of_body_.size();
  std::vector<Branch> branches;
  branches.reserve(layout_.held.size());
  const auto last = [&](std::size_t joint, std::size_t side) {
    const auto of = [&](std::size_t component) {
      const auto port = static_cast<std::size_t>(bodies_->ends()[2 * joint + component][side]);
      return place[static_cast<std::size_t>(layout_.of_port[port][0])];
    };
    return std::max(of(0), of(1));
  };
  for (std::size_t j = 0; j < layout_.held.size(); ++j) {
    const Joint& joint = bodies_->assembly().joints[j];
    const auto a = static_cast<std::size_t>(joint.body_a),
               b = static_cast<std::size_t>(joint.body_b);
    if (layout_.held[j] == Held::fully && conducts[a] != 0 && conducts[b] != 0)
      branches.push_back({last(j, 0), a, b});
    if (layout_.held[j] != Held::not_at_all) continue;
    if (conducts[a] != 0) branches.push_back({last(j, 0), ground, a});
    if (conducts[b] != 0) branches.push_back({last(j, 1), ground, b});
  }
  std::ranges::sort(branches, {}, &Branch::place);
  return branches;
}

// Minimum degree is the quicker to find, and mostly the better one. Where much is left to do for
// each nonzero, nested dissection is tried too.
std::vector<int> Structure::order_of_unknowns(const Supervariables& groups) const {
  constexpr double much = 150.0;  // operations
  const int unknowns = groups.unknowns();
  const Graph graph = groups.graph().topLeftCorner(unknowns, unknowns);
  std::vector<int> order = least_degree_order(graph);
  const Cost cost = cost_of(graph, order, groups.sizes());
  if (cost.operations <= much * cost.nonzeros) return order;
  std::vector<std::array<int, 2>> bodies_of(static_cast<std::size_t>(layout_.unknowns), {-1, -1});
  for (int body = 0; body < static_cast<int>(op_of_body_.size()); ++body) {
    const Index ports = op_of_body_[static_cast<std::size_t>(body)]->impedance.rows();
    for (Index port = bodies_->first_port(body); port < bodies_->first_port(body) + ports; ++port) {
      auto& [a, b] = bodies_of[static_cast<std::size_t>(unknowns_of_port(port)[0])];
      if (a < 0) a = body;
      b = body;
    }
  }
  if (!tops_of_ties_.empty()) bodies_of.pop_back();  // all feel it: it comes last
  const std::vector<int> part_of_row = dissection(bodies_->assembly(), bodies_of);
  std::vector<int> parts(static_cast<std::size_t>(unknowns), unknowns - 1);
  for (std::size_t row = 0; row < part_of_row.size(); ++row)
    parts[static_cast<std::size_t>(groups.of_rows()[row])] = part_of_row[row];
  std::vector<int> other = least_degree_order(graph, std::move(parts));
  return cost_of(graph, other, groups.sizes()).operations < cost.operations ? other : order;
}

// The multipliers of two bodies that share a joint say the same of it with opposite signs: over all
// bodies they are the nodes of a network, and the joints its branches. Where joints have been
// eliminated, bodies that they connect have their pivots, but for one in each connected part that
// no branch leads out of yet. So a body's multipliers follow the joint by which its part meets
// another one, or a body without any; those of clipped bodies that are no such nodes come last.
std::vector<int> Structure::elimination_order(const Supervariables& groups) const {
  std::vector<int> order = order_of_unknowns(groups);
  std::vector<int> place(static_cast<std::size_t>(groups.count()), 2 * groups.unknowns());
  for (std::size_t i = 0; i < order.size(); ++i)
    place[static_cast<std::size_t>(order[i])] = 2 * static_cast<int>(i);

  const std::size_t ground = op_of_body_.size();
  const auto rows = [&](std::size_t body) {
    return body == ground ? Index{0} : op_of_body_[body]->compatibility.rows();
  };
  DisjointSets parts(ground + 1);
  for (std::size_t body = 0; body < ground; ++body)
    if (rows(body) == 0) parts.unite(ground, body);
  std::vector<int> place_of_row;
  for (const int group : groups.of_rows())
    place_of_row.push_back(place[static_cast<std::size_t>(group)]);
  for (const Branch& branch : network(place_of_row)) {
    std::size_t stays = parts.find(branch.a), goes = parts.find(branch.b), through = branch.b;
    if (stays == goes) continue;
    if (goes == ground || (stays != ground && rows(stays) < rows(goes))) {
      std::swap(stays, goes);
      through = branch.a;
    }
    if (rows(through) < rows(goes)) continue;
    parts.unite(stays, goes);
    const auto first = static_cast<std::size_t>(first_multiplier(goes));
    place[static_cast<std::size_t>(groups.of_rows()[first])] = branch.place + 1;
  }
  for (int group = groups.unknowns(); group < groups.count(); ++group) order.push_back(group);
  std::ranges::stable_sort(order, {},
                           [&](int group) { return place[static_cast<std::size_t>(group)]; });
  return order;
}

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
