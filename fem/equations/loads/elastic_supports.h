/// Springs to the ground that act on the elastic deformation of a free body. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "fem/base/values/unit_load.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// (K + W k W') u = f for loads f that close: with the free body's responses u_f to f and U_W to W (columns
/// of W: the springs' unit forces), u = u_f - U_W r + a rigid motion. The springs' forces r close by
/// themselves, so r = N m with N the null space of R'W, and the rigid motion drops out:
///   N'(W'U_W + 1/k) N m = N'W'u_f.
/// No spring is too soft or too stiff for this: 1/k is a flexibility beside that of the body.
class ElasticSupports {
public:
  /// @throws std::invalid_argument for a stiffness that is negative or not finite, and as LoadedSurface
  ElasticSupports(const Grid& grid, const std::vector<ElasticSupport>& supports);

  /// W, one column per spring (3 n_nodes x m); springs without stiffness have none.
  const Eigen::MatrixXd& unit_forces() const noexcept { return forces_; }

  /// k, one per spring of unit_forces().
  const Eigen::VectorXd& stiffness_N_m() const noexcept { return stiffness_N_m_; }

  /// @param displacement  of the loads, then of the m unit forces, on the free body without rigid part
  /// @return of the loads with springs
  Eigen::MatrixXd apply(Eigen::MatrixXd displacement) const;

  /// The same of some nodes.
  /// @param forces    rows of unit_forces() of the nodes that count in sums over the body, zeros of others
  /// @param complete  makes sums over these nodes those over all
  Eigen::MatrixXd apply(Eigen::MatrixXd displacement, const Eigen::MatrixXd& forces,
                        const std::function<void(Eigen::MatrixXd&)>& complete) const;

private:
  Eigen::MatrixXd forces_, closed_;  // closed_: N
  Eigen::VectorXd stiffness_N_m_;
};

}  // namespace fem
