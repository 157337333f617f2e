// The order of elimination (S7): unknowns by their graph, each body's multipliers behind what
// determines them, so that no pivot is small although there is no pivoting.
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "sim/structure/disjoint_sets.hpp"
#include "sim/structure/dissection.hpp"
#include "sim/structure/row_echelon.hpp"
#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double determined = 0.01;  // least share of a joint in multipliers to give them a pivot
constexpr double least_said = 0.03;  // of what several unknowns say together, likewise

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
std::vector<Structure::Branch> Structure::network(const std::vector<int>& place,
                                                  const std::vector<char>& conducts) const {
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

// Multipliers that no network determines, by the place at which the unknowns so far do: C is of
// full rank in the columns of those with a place, its rows being what unknowns say of multipliers.
// @return of each row of the mixed form; −1 where there is none.
std::vector<int> Structure::places_of_others(const std::vector<int>& place,
                                             const std::vector<char>& others) const {
  std::map<std::pair<int, int>, RowEchelon::Row> said;  // by place and unknown
  for (std::size_t body = 0; body < others.size(); ++body) {
    if (others[body] == 0) continue;
    const MatrixXd& N = op_of_body_[body]->compatibility;
    for (Index port = 0; port < N.cols(); ++port) {
      const int unknown = unknowns_of_port(bodies_->first_port(static_cast<int>(body)) + port)[0];
      RowEchelon::Row& row = said[{place[static_cast<std::size_t>(unknown)], unknown}];
      for (Index i = 0; i < N.rows(); ++i)
        row.emplace_back(static_cast<int>(first_multiplier(body) + i), N(i, port));
    }
  }
  std::vector<int> found(place.size(), -1);
  RowEchelon rows(least_said);
  for (const auto& [key, row] : said)
    if (const int column = rows.add(row); column >= 0)
      found[static_cast<std::size_t>(column)] = key.first;
  return found;
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
  // Parts are of supervariables; rows of one are in the same bodies, and so in one part.
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
// another one, or a body without any; those of clipped bodies that are no such nodes follow what
// determines them, or come last.
std::vector<int> Structure::elimination_order(const Supervariables& groups) const {
  std::vector<int> order = order_of_unknowns(groups);
  std::vector<int> place(static_cast<std::size_t>(groups.count()), 2 * groups.unknowns());
  for (std::size_t i = 0; i < order.size(); ++i)
    place[static_cast<std::size_t>(order[i])] = 2 * static_cast<int>(i);

  const std::size_t ground = op_of_body_.size();
  const auto rows = [&](std::size_t body) {
    return body == ground ? Index{0} : op_of_body_[body]->compatibility.rows();
  };
  // Bodies without multipliers are the ground, to which a part may be connected.
  DisjointSets parts(ground + 1);
  for (std::size_t body = 0; body < ground; ++body)
    if (rows(body) == 0) parts.unite(ground, body);
  std::vector<int> place_of_row;
  for (const int group : groups.of_rows())
    place_of_row.push_back(place[static_cast<std::size_t>(group)]);
  const std::vector<char> conducts = conducting();
  // Branches in the order in which they are eliminated: each that joins two parts gives one of them
  // its pivot.
  for (const Branch& branch : network(place_of_row, conducts)) {
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
  // Those of cut bodies, and of what they keep apart from all bodies without multipliers.
  constexpr long small_part = 50;  // larger ones take longer than their last multipliers do
  std::vector<long> bodies_in(ground + 1, 0);
  for (std::size_t body = 0; body < ground; ++body) ++bodies_in[parts.find(body)];
  std::vector<char> others(ground, 0);
  for (std::size_t body = 0; body < ground; ++body) {
    const std::size_t part = parts.find(body);
    others[body] = part != parts.find(ground) && bodies_in[part] <= small_part ? 1 : 0;
  }
  const std::vector<int> found = places_of_others(place_of_row, others);
  for (std::size_t body = 0; body < ground; ++body) {
    if (others[body] == 0) continue;
    const auto first = static_cast<std::size_t>(first_multiplier(body));
    const std::span places(found.data() + first, static_cast<std::size_t>(rows(body)));
    const auto [earliest, latest] = std::ranges::minmax(places);
    place[static_cast<std::size_t>(groups.of_rows()[first])] =
        earliest < 0 ? 2 * groups.unknowns() : latest + 1;
  }
  for (int group = groups.unknowns(); group < groups.count(); ++group) order.push_back(group);
  std::ranges::stable_sort(order, {},
                           [&](int group) { return place[static_cast<std::size_t>(group)]; });
  return order;
}

}  // namespace havers::sim
