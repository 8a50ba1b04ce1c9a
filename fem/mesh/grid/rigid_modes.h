/// Mass integrals of the nodes, the six rigid modes, and the balancing of load vectors. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/per_cell.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Integrals over the body of N_i, N_i x, N_i y, N_i z for every node (n x 4). Gauss points in number that
/// makes them exact on isoparametric cells: mass, first and second moments, body loads and balancing all come
/// from this table.
using NodeIntegrals = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
NodeIntegrals integrate_nodes(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours);

/// The same over the cells of some volume groups only; zero at the other nodes.
/// @throws std::invalid_argument if one of the groups has no cells
NodeIntegrals integrate_nodes(const Grid& grid, const std::vector<int>& volume_ids);

MassProperties mass_properties(const Grid& grid, const NodeIntegrals& integrals, double density_kg_m3);

/// Displacements of unit translations along and unit rotations about x, y, z through `centre` (3 n x 6).
Eigen::MatrixXd rigid_modes(const Grid& grid, const Eigen::Vector3d& centre);

/// fx, fy, fz, mx, my, mz about `centre` of each column of nodal forces (6 x columns).
Eigen::MatrixXd resultants(const Grid& grid, const Eigen::MatrixXd& force, const Eigen::Vector3d& centre);

/// Takes resultants out of loads and rigid motion out of displacements, both by the mass (of density 1). Grid
/// and integrals are referred to, not copied.
class RigidBalance {
public:
  RigidBalance(const Grid& grid, const NodeIntegrals& integrals);
  RigidBalance(const Grid& grid, NodeIntegrals&& integrals) = delete;  // would be gone
  void balance(Eigen::MatrixXd& force) const;                          ///< f - M R (R'MR)^-1 R'f
  void remove_motion(Eigen::MatrixXd& displacement) const;             ///< u - R (R'MR)^-1 R'M u

  /// The same of some nodes.
  /// @param node      theirs
  /// @param counted   whether each counts in the sum, R'M u
  /// @param complete  given the sums of these nodes (6 x columns), makes them those of all nodes
  void remove_motion(const std::vector<std::int32_t>& node, const std::vector<char>& counted,
                     const std::function<void(Eigen::MatrixXd&)>& complete,
                     Eigen::MatrixXd& displacement) const;

private:
  Eigen::Vector3d place_m(Eigen::Index node) const;  // from the centre of mass
  Eigen::Vector3d moment(Eigen::Index node) const;   // of its mass about it: integral of N_i x
  double mass(Eigen::Index node) const { return integrals_(node, 0); }  // integral of N_i

  const Grid& grid_;
  const NodeIntegrals& integrals_;
  Eigen::Vector3d centre_m_;
  Eigen::Matrix<double, 6, 6> inverse_;  // (R'MR)^-1
};

}  // namespace fem
