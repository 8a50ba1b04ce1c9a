/// Rigid masses that move with surfaces of a vibrating body. Internal to fem.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/base/values/natural_mode.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// W A W', added to the mass matrix: W'u is the mean motion of each surface (translation of its centre, then
/// rotation), conjugate to its six unit resultants in W, and A the mass matrix of the rigid body about that
/// centre. Translations and rotations of the whole body have exactly the rigid body's energy.
class AttachedMasses {
public:
  /// @throws std::invalid_argument for masses or inertias that are negative or not finite, and as
  /// LoadedSurface
  AttachedMasses(const Grid& grid, const std::vector<AttachedMass>& masses);

  /// Adds the inertia forces of a motion with unit acceleration.
  void add_to(const Eigen::MatrixXd& motion, Eigen::MatrixXd& force) const;

private:
  Eigen::MatrixXd resultants_;  // W, 3 n_nodes x 6 a mass
  Eigen::MatrixXd mass_;        // A
};

}  // namespace fem
