#include "fem/solve/modes/vibrating_body.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/base/common/dense_algebra.h"
#include "fem/equations/loads/clamps.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/rigid_modes.h"

namespace fem {

VibratingBody::VibratingBody(const Grid& grid, const CellsOfNodes& cells,
                             const std::vector<std::vector<std::int32_t>>& colours, const Body& body,
                             const std::vector<AttachedMass>& attached)
    : graph_(make_node_graph(grid, cells)),
      mass_(grid, colours, graph_, body.material.density_kg_m3),
      attached_(grid, attached),
      matrix_(make_matrix(graph_)),
      springs_(grid, body.elastic_supports),
      clamped_(clamped_unknowns(grid, body.clamps)) {
  if (!clamped_.empty() && !body.elastic_supports.empty())
    throw std::invalid_argument(
        "natural frequencies of a body with clamps and elastic supports: leave one of them out");
  assemble_stiffness(grid, colours, graph_, lame(body.material), matrix_);
  const auto order = order_nodes(graph_);
  if (!clamped_.empty()) {
    clamp(clamped_, matrix_);
    factor_.emplace(graph_, order);
    factor_->factorise(matrix_);
    return;
  }
  SymmetricMatrix held = matrix_;
  supports_.emplace(choose_supports(grid), held);
  factor_.emplace(graph_, order);
  factor_->factorise(held);
  const Eigen::Map<const Eigen::Matrix3Xd> nodes(grid.xyz_m.data(), 3, grid.n_nodes);
  rigid_ = rigid_modes(grid, nodes.rowwise().mean());
  // Vectors here are those of the unknowns that are left: nothing at nodes that hang.
  for (const auto node : grid.hanging.node) rigid_.middleRows<3>(3 * Eigen::Index(node)).setZero();
  for (int pass = 0; pass < 2; ++pass) {  // the second one mends the rounding of the first
    const Eigen::MatrixXd gram = transposed_product(rigid_, mass(rigid_));
    rigid_ = orthonormal_by(gram, rigid_);
  }
  mass_rigid_ = mass(rigid_);
  if (springs_.unit_forces().cols() > 0) put_on_springs();
}

/// Forces r of the springs and rigid motions a that they hold (R_h):
///   (W'GW + 1/k) r - W'R_h a = W'G f,   R_h'W r = R_h'f,   u = G (f - W r) + R_h a,
/// G the inverse of the free body. Springs without stiffness are not among W.
void VibratingBody::put_on_springs() {
  const auto& forces = springs_.unit_forces();
  const auto n = forces.cols();
  constexpr double negligible = 1e-9;  // of the largest singular value: springs in line to that precision
  const RowSpace held = row_space(
      springs_.stiffness_N_m().cwiseSqrt().asDiagonal() * transposed_product(forces, rigid_), negligible);
  n_held_by_springs_ = held.rank;
  rigid_ = product(rigid_, held.vector);
  mass_rigid_ = product(mass_rigid_, held.vector);
  answers_ = free_inverse(forces);
  const Eigen::MatrixXd coupling = transposed_product(forces, rigid_.leftCols(n_held_by_springs_));
  spring_system_ = Eigen::MatrixXd::Zero(n + n_held_by_springs_, n + n_held_by_springs_);
  spring_system_.topLeftCorner(n, n) = transposed_product(forces, answers_);
  spring_system_.diagonal().head(n) += springs_.stiffness_N_m().cwiseInverse();
  spring_system_.topRightCorner(n, n_held_by_springs_) = -coupling;
  spring_system_.bottomLeftCorner(n_held_by_springs_, n) = coupling.transpose();
}

Eigen::Index VibratingBody::n_vibrating() const noexcept {
  if (!clamped_.empty()) return n_unknowns() - static_cast<Eigen::Index>(clamped_.size());
  return n_unknowns() - (6 - n_held_by_springs_);
}

Eigen::MatrixXd VibratingBody::unheld_motions() const {
  if (!clamped_.empty()) return Eigen::MatrixXd(n_unknowns(), 0);
  return rigid_.rightCols(rigid_.cols() - n_held_by_springs_);
}

Eigen::MatrixXd VibratingBody::mass(const Eigen::MatrixXd& motion) const {
  Eigen::MatrixXd force = mass_ * motion;
  attached_.add_to(motion, force);
  return force;
}

void VibratingBody::clear_clamped(Eigen::MatrixXd& vectors) const {
  clear_rows(clamped_, vectors);
}

Eigen::MatrixXd VibratingBody::stiffness(const Eigen::MatrixXd& motion) const {
  Eigen::MatrixXd force = multiply(matrix_, motion);
  clear_clamped(force);
  const auto& springs = springs_.unit_forces();
  force += product(springs, springs_.stiffness_N_m().asDiagonal() * transposed_product(springs, motion));
  return force;
}

double VibratingBody::rounding_of_rigid_part(const Eigen::VectorXd& motion) const {
  constexpr double of_a_row = 16;  // its terms, some hundred, round independently
  if (!clamped_.empty()) return 0;
  const Eigen::VectorXd rigid = product(rigid_, transposed_product(mass_rigid_, motion));
  double sum = 0;
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    const double term = matrix_.value[matrix_.column_begin[i]] * rigid[i];
    sum += term * term;
  }
  return of_a_row * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

Eigen::MatrixXd VibratingBody::free_inverse(const Eigen::MatrixXd& force) const {
  Eigen::MatrixXd balanced = force - product(mass_rigid_, transposed_product(rigid_, force));
  clear_rows(supports_->unknowns(), balanced);
  Eigen::MatrixXd motion = factor_->solve(balanced);
  motion -= product(rigid_, transposed_product(mass_rigid_, motion));
  return motion;
}

Eigen::MatrixXd VibratingBody::inverse(const Eigen::MatrixXd& force) const {
  if (!clamped_.empty()) {
    Eigen::MatrixXd loads = force;
    clear_clamped(loads);
    return factor_->solve(loads);
  }
  Eigen::MatrixXd motion = free_inverse(force);
  if (answers_.cols() == 0) return motion;
  const auto held = rigid_.leftCols(n_held_by_springs_);
  Eigen::MatrixXd wanted(answers_.cols() + n_held_by_springs_, force.cols());
  wanted << transposed_product(springs_.unit_forces(), motion), transposed_product(held, force);
  const Eigen::MatrixXd found = solve(spring_system_, wanted);
  motion += product(held, found.bottomRows(n_held_by_springs_));
  subtract_product(answers_, found.topRows(answers_.cols()), motion);
  return motion;
}

}  // namespace fem
