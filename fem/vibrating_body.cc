#include "fem/vibrating_body.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/clamps.h"
#include "fem/rigid_modes.h"
#include "fem/stiffness.h"

namespace fem {

VibratingBody::VibratingBody(const Grid& grid, const CellsOfNodes& cells,
                             const std::vector<std::vector<std::int32_t>>& colours, const Body& body,
                             const CellMaterials& materials)
    : graph_(make_node_graph(grid, cells)),
      mass_(grid, colours, graph_, materials.density_kg_m3()),
      matrix_(make_matrix(graph_)),
      springs_(grid, body.elastic_supports),
      clamped_(clamped_unknowns(grid, body.clamps)) {
  if (!clamped_.empty() && !body.elastic_supports.empty())
    throw std::invalid_argument(
        "natural frequencies of a body with clamps and elastic supports: leave one of them out");
  assemble_stiffness(grid, colours, graph_, materials.elastic(), matrix_);
  const auto order = order_nodes(graph_);
  if (!clamped_.empty()) {
    clamp(clamped_, matrix_);
    factor_.emplace(matrix_, order);
    factor_->factorise(matrix_);
    return;
  }
  SymmetricMatrix held = matrix_;
  supports_.emplace(choose_supports(grid), held);
  factor_.emplace(held, order);
  factor_->factorise(held);
  const Eigen::Map<const Eigen::Matrix3Xd> nodes(grid.xyz_m.data(), 3, grid.n_nodes);
  rigid_ = rigid_modes(grid, nodes.rowwise().mean());
  for (int pass = 0; pass < 2; ++pass) {  // the second one mends the rounding of the first
    const Eigen::MatrixXd gram = rigid_.transpose() * mass(rigid_);
    rigid_ = gram.llt().matrixU().solve<Eigen::OnTheRight>(rigid_);
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
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
      springs_.stiffness_N_m().cwiseSqrt().asDiagonal() * (forces.transpose() * rigid_), Eigen::ComputeFullV);
  constexpr double negligible = 1e-9;  // of the largest singular value: springs in line to that precision
  for (const double value : svd.singularValues())
    n_held_by_springs_ += value > negligible * svd.singularValues()[0];
  rigid_ *= svd.matrixV();
  mass_rigid_ *= svd.matrixV();
  answers_ = free_inverse(forces);
  const Eigen::MatrixXd coupling = forces.transpose() * rigid_.leftCols(n_held_by_springs_);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + n_held_by_springs_, n + n_held_by_springs_);
  system.topLeftCorner(n, n) = forces.transpose() * answers_;
  system.diagonal().head(n) += springs_.stiffness_N_m().cwiseInverse();
  system.topRightCorner(n, n_held_by_springs_) = -coupling;
  system.bottomLeftCorner(n_held_by_springs_, n) = coupling.transpose();
  spring_system_.compute(system);
}

Eigen::Index VibratingBody::n_vibrating() const noexcept {
  if (!clamped_.empty()) return n_unknowns() - static_cast<Eigen::Index>(clamped_.size());
  return n_unknowns() - (6 - n_held_by_springs_);
}

void VibratingBody::clear_clamped(Eigen::MatrixXd& vectors) const {
  for (const auto unknown : clamped_) vectors.row(unknown).setZero();
}

Eigen::MatrixXd VibratingBody::stiffness(const Eigen::MatrixXd& motion) const {
  Eigen::MatrixXd force = multiply(matrix_, motion);
  clear_clamped(force);
  const auto& springs = springs_.unit_forces();
  force += springs * (springs_.stiffness_N_m().asDiagonal() * (springs.transpose() * motion));
  return force;
}

double VibratingBody::rounding_of_rigid_part(const Eigen::VectorXd& motion) const {
  constexpr double of_a_row = 16;  // its terms, some hundred, round independently
  if (!clamped_.empty()) return 0;
  const Eigen::VectorXd rigid = rigid_ * (mass_rigid_.transpose() * motion);
  double sum = 0;
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    const double term = matrix_.value[matrix_.column_begin[i]] * rigid[i];
    sum += term * term;
  }
  return of_a_row * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

Eigen::MatrixXd VibratingBody::free_inverse(const Eigen::MatrixXd& force) const {
  Eigen::MatrixXd balanced = force - mass_rigid_ * (rigid_.transpose() * force);
  supports_->clear(balanced);
  Eigen::MatrixXd motion = factor_->solve(balanced);
  motion -= rigid_ * (mass_rigid_.transpose() * motion);
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
  wanted << springs_.unit_forces().transpose() * motion, held.transpose() * force;
  const Eigen::MatrixXd found = spring_system_.solve(wanted);
  motion += held * found.bottomRows(n_held_by_springs_) - answers_ * found.topRows(answers_.cols());
  return motion;
}

}  // namespace fem
