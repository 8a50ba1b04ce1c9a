/// Stress of a finite-element solution in one cell, and on one free face. Internal to fem.
///
/// Blocks are row-major: displacement n_nodes x 3 K, stress n x 6 K; the three (six) components of a load
/// case are neighbours. Stress components: xx, yy, zz, xy, yz, xz.
#pragma once

#include <Eigen/Dense>

#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/grid.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ConstBlock = Eigen::Ref<const RowMajor>;

/// Von Mises stress of a tensor.
double von_mises(const double* stress);

/// Hooke's law at the tabulated points of cells; keeps its work space from cell to cell.
class CellStress {
public:
  CellStress(const Grid& grid, const Tabulation& at, const PerCell<Lame>& elastic,
             const ConstBlock& displacement);
  void operator()(std::size_t cell, Eigen::Ref<RowMajor> stress);

private:
  const Grid& grid_;
  const Tabulation& at_;
  PerCell<Lame> elastic_;
  ConstBlock displacement_;
  CellGradients gradients_;
  RowMajor local_, gradient_;
};

/// Stress at tabulated points of faces that carry no traction: strains along the face from the displacement
/// of its own nodes, all stress across it zero. At the face's Gauss points these strains are superconvergent,
/// while the derivative across the face, which is not taken, would be the least accurate of all.
class FreeFaceStress {
public:
  FreeFaceStress(const Grid& grid, const Tabulation& at, const PerCell<Lame>& elastic,
                 const ConstBlock& displacement);
  void operator()(const BoundaryFace& face, Eigen::Ref<RowMajor> stress);

private:
  const Grid& grid_;
  const Tabulation& at_;
  PerCell<Lame> elastic_;
  ConstBlock displacement_;
};

}  // namespace fem
