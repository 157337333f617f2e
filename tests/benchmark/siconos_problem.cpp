#include "tests/benchmark/siconos_problem.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

extern "C" {
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
}

namespace havers::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// W = H Ā⁻¹ Hᵀ and the gaps without any reaction.
struct Delassus {
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd free;
};

// Ā⁻¹ of a body, zero where the boundary holds it.
MatrixXd inverse_of(const sim::BodyOperator& op, const std::vector<char>& held) {
  std::vector<Index> free;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] == 0) free.push_back(static_cast<Index>(i));
  MatrixXd inverse = MatrixXd::Zero(op.shifted.rows(), op.shifted.cols());
  const MatrixXd of_free = MatrixXd(op.shifted(free, free)).inverse();
  inverse(free, free) = of_free;
  return inverse;
}

Delassus delassus_of(const sim::Bodies& bodies, const sim::JointStep& step) {
  Delassus problem{{}, step.predicted};
  for (const sim::BodyClass& group : bodies.classes()) {
    const Index n = group.op.shifted.rows(), ports = group.op.ports.rows();
    const auto held = bodies.held().begin() + bodies.first_dof(group.bodies.front());
    const MatrixXd inverse = inverse_of(group.op, {held, held + n});
    const MatrixXd answers = group.op.ports * inverse * group.op.ports.transpose();
    for (const int body : group.bodies) {
      const VectorXd alone =
          group.op.ports * (inverse * step.forces.segment(bodies.first_dof(body), n));
      for (Index i = 0; i < ports; ++i) {
        const auto port = [&](Index k) {
          return bodies.ports()[static_cast<std::size_t>(bodies.first_port(body) + k)];
        };
        const double sign_i = port(i).side == sim::PortSide::b ? 1.0 : -1.0;
        problem.free(port(i).unknown) += sign_i * alone(i);
        for (Index j = 0; j < ports; ++j) {
          const double sign_j = port(j).side == sim::PortSide::b ? 1.0 : -1.0;
          problem.entries.emplace_back(port(i).unknown, port(j).unknown,
                                       sign_i * sign_j * answers(i, j));
        }
      }
    }
  }
  return problem;
}

// Row of the third dimension's form: (normal, tangential, nothing) of each joint.
int spatial(Index row) {
  return static_cast<int>(3 * (row / 2) + row % 2);
}

struct Deleter {
  void operator()(FrictionContactProblem* problem) const { frictionContactProblem_free(problem); }
  void operator()(SolverOptions* options) const { solver_options_delete(options); }
};

}  // namespace

SiconosAnswer solve_with_siconos(const sim::Bodies& bodies, const sim::JointStep& step,
                                 SiconosSolver solver, double tolerance, int max_iterations) {
  const Delassus problem = delassus_of(bodies, step);
  const Index rows = problem.free.size();
  const auto joints = static_cast<int>(rows / 2);
  Eigen::SparseMatrix<double> W(rows, rows);
  W.setFromTriplets(problem.entries.begin(), problem.entries.end());

  // Joints differ in cohesion: r' = r + c n obeys Coulomb's law without any.
  VectorXd cohesion = VectorXd::Zero(rows);
  for (int j = 0; j < joints; ++j)
    cohesion(2 * j) = step.laws[static_cast<std::size_t>(j)].cohesion;
  const double force = cohesion.maxCoeff();
  const double length = force * W.diagonal().maxCoeff();
  const VectorXd q = (problem.free - W * cohesion) / length;

  const int size = 3 * joints;
  NumericsMatrix* M = NM_create(NM_SPARSE, size, size);
  NM_triplet_alloc(M, W.nonZeros() + joints);
  for (int column = 0; column < W.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(W, column); entry; ++entry)
      NM_zentry(M, spatial(entry.row()), spatial(entry.col()), entry.value() * force / length, 0.0);
  for (int j = 0; j < joints; ++j) NM_zentry(M, 3 * j + 2, 3 * j + 2, 1.0, 0.0);

  // Siconos frees these arrays with the problem, by free().
  auto* shift = static_cast<double*>(std::calloc(static_cast<std::size_t>(size), sizeof(double)));
  auto* mu = static_cast<double*>(std::calloc(static_cast<std::size_t>(joints), sizeof(double)));
  for (Index row = 0; row < rows; ++row) shift[spatial(row)] = q(row);
  for (int j = 0; j < joints; ++j) mu[j] = step.laws[static_cast<std::size_t>(j)].friction;
  const std::unique_ptr<FrictionContactProblem, Deleter> contact(
      frictionContactProblem_new_with_data(3, joints, M, shift, mu));
  const std::unique_ptr<SolverOptions, Deleter> options(solver_options_create(
      solver == SiconosSolver::nsgs ? SICONOS_FRICTION_3D_NSGS : SICONOS_FRICTION_3D_NSN_AC));
  options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = max_iterations;

  std::vector<double> reaction(static_cast<std::size_t>(size), 0.0), velocity = reaction;
  SiconosAnswer answer;
  const std::clock_t begin = std::clock();
  answer.converged =
      fc3d_driver(contact.get(), reaction.data(), velocity.data(), options.get()) == 0;
  answer.cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  answer.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  answer.reactions.resize(rows);
  for (Index row = 0; row < rows; ++row)
    answer.reactions(row) =
        force * reaction[static_cast<std::size_t>(spatial(row))] - cohesion(row);
  return answer;
}

}  // namespace havers::test
