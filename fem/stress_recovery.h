/// Stress of a finite-element solution at points of the cells, and at the nodes. Internal to fem.
///
/// Blocks are row-major: displacement n_nodes x 3 K, stress n x 6 K; the three (six) components of a load
/// case are neighbours. Stress components: xx, yy, zz, xy, yz, xz.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/grid.h"
#include "fem/reference_cell.h"
#include "fem/stiffness.h"

namespace fem {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ConstBlock = Eigen::Ref<const RowMajor>;

/// Stress at the tabulated points of all cells: row cell * at.n_points + q.
RowMajor stress_at_points(const Grid& grid, const Tabulation& at, const Lame& elastic,
                          const ConstBlock& displacement);

/// The mean over a node's cells of the stress there.
/// @param stress  n_nodes x 6 K, overwritten
void average_stress(const Grid& grid, const CellsOfNodes& cells, const Lame& elastic,
                    const ConstBlock& displacement, Eigen::Ref<RowMajor> stress);

/// Superconvergent patch recovery (Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33, 1992): around every
/// interior corner a polynomial is fitted to the samples at the k^3 Gauss points of its cells. A node's value
/// is the mean of the fits around it, weighted with the trilinear hats of their corners; nodes that no hat
/// reaches (the boundary) take the mean of the fits of the interior corners of their cells. A cell without
/// interior corners uses its boundary corners.
/// @param samples  (n_cells k^3) x columns: any quantity at gauss_in_cell(k, k)
/// @param nodal    n_nodes x columns, overwritten
void recover_by_patches(const Grid& grid, const CellsOfNodes& cells, const ConstBlock& samples,
                        Eigen::Ref<RowMajor> nodal);

}  // namespace fem
