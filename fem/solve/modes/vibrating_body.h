/// Stiffness and mass of a body that is clamped, free, or on springs, and what inverts the stiffness on the
/// motions that it resists. Internal to fem.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/equations/loads/elastic_supports.h"
#include "fem/equations/loads/supports.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/equations/operators/mass_matrix.h"
#include "fem/mesh/grid/grid.h"
#include "fem/solve/modes/attached_masses.h"

namespace fem {

/// K u + W k W'u = f with M, attached masses included: W and k of the elastic supports, R the rigid motions
/// (R'MR = I), Z those of them that nothing holds: none of a clamped body, all six of a free one without
/// springs.
class VibratingBody {
public:
  /// Assembles and factorises.
  /// @throws std::invalid_argument for clamps that leave a rigid motion or come with elastic supports
  /// @throws SolveFailed if the factorisation fails
  VibratingBody(const Grid& grid, const CellsOfNodes& cells,
                const std::vector<std::vector<std::int32_t>>& colours, const Body& body,
                const std::vector<AttachedMass>& attached);

  Eigen::Index n_unknowns() const noexcept { return static_cast<Eigen::Index>(matrix_.n); }
  /// Without the clamped unknowns and the rigid motions that nothing holds.
  Eigen::Index n_vibrating() const noexcept;

  /// Z: rigid motions that nothing holds, orthonormal in the mass; none of a clamped body.
  Eigen::MatrixXd unheld_motions() const;

  Eigen::MatrixXd mass(const Eigen::MatrixXd& motion) const;
  /// Forces on the unknowns that are not clamped, zero on those that are.
  Eigen::MatrixXd stiffness(const Eigen::MatrixXd& motion) const;
  /// What rounding may leave of K times the rigid part of a motion, which is nothing: on soft springs the
  /// body moves as if rigid, and its inertia forces may be smaller than that. In the norm over all unknowns.
  double rounding_of_rigid_part(const Eigen::VectorXd& motion) const;
  /// The motion with Z'M u = 0 that answers f - M Z Z'f; clamped unknowns stay.
  Eigen::MatrixXd inverse(const Eigen::MatrixXd& force) const;
  /// Sets the clamped unknowns to zero.
  void clear_clamped(Eigen::MatrixXd& vectors) const;

private:
  Eigen::MatrixXd free_inverse(const Eigen::MatrixXd& force) const;
  void put_on_springs();

  NodeGraph graph_;
  MassMatrix mass_;
  AttachedMasses attached_;
  SymmetricMatrix matrix_;
  ElasticSupports springs_;
  std::vector<std::int64_t> clamped_;
  std::optional<Supports> supports_;
  std::optional<CholmodFactor> factor_;
  Eigen::MatrixXd rigid_, mass_rigid_;  // R, M R: those that springs hold first, Z last
  Eigen::Index n_held_by_springs_ = 0;
  Eigen::MatrixXd answers_;        // of the springs' unit forces on the free body
  Eigen::MatrixXd spring_system_;  // unknowns: springs' forces, rigid motions they hold
};

}  // namespace fem
