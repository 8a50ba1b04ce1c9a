/// Stress at the nodes. Internal to fem.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/mesh/grid/grid.h"
#include "fem/stress/cells/cell_stress.h"
#include "fem/stress/recovery/stress_samples.h"

namespace fem {

/// The mean over a node's cells of the stress there.
/// @param stress  n_nodes x 6 K, overwritten
void average_stress(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                    const ConstBlock& displacement, Eigen::Ref<RowMajor> stress);

/// What recover_by_patches fits.
struct PatchRule {
  int degree = 0;  ///< of the polynomials; 0: the grid's
  /// Hexahedra around a boundary corner that carries a patch of its own take in the cells around them. A
  /// patch of one or two cells follows what is wrong with their samples, and makes it more at its edges.
  bool widens_at_boundary = false;
};

/// Nodes whose stress is recovered, ascending; the others are left zero. None: all.
using NodeSelection = std::optional<std::vector<std::int32_t>>;

/// Superconvergent patch recovery (Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33, 1992): around every
/// interior corner a polynomial is fitted to the samples of its cells. A node's value is the mean of the fits
/// around it, weighted with the trilinear hats of their corners; for a boundary corner stand the interior
/// corners joined to it by edges. A cell without interior corners uses its boundary corners. Beyond the
/// paper: free faces add samples on the surface itself, so that peaks there are interpolated; patches inside
/// cylinder charts are fitted in r, theta, z, components too.
/// Tetrahedra: patches around all corners, boundary ones too, with complete quadratic fits; where the cells
/// around a corner have too few samples, the cells around those count as well. A middle of an edge has the
/// mean of its two ends' fits.
/// @param charts  of the grid's volumes; values must be stresses unless empty
/// @param values  samples x columns
/// @param nodal   n_nodes x columns, overwritten
void recover_by_patches(const Grid& grid, const CellsOfNodes& cells, const std::vector<CylinderChart>& charts,
                        const StressSamples& samples, const ConstBlock& values, Eigen::Ref<RowMajor> nodal,
                        const PatchRule& rule = {}, const NodeSelection& selection = {});

/// Stress at the nodes by patches. Where cells hardly compress, lambda div u is recovered by itself
/// (volumetric_stress.h), by fits one degree lower, and patches widen at the boundary.
/// @param free    faces that carry no traction
/// @param hardly_compresses  any cell of the body (any_hardly_compresses)
/// @param stress  n_nodes x 6 K, overwritten
void recover_stress(const Grid& grid, const CellsOfNodes& cells, const std::vector<CylinderChart>& charts,
                    const std::vector<BoundaryFace>& free, const PerCell<Lame>& elastic,
                    bool hardly_compresses, const ConstBlock& displacement, Eigen::Ref<RowMajor> stress,
                    const NodeSelection& selection = {});

}  // namespace fem
