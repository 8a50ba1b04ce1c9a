/// How far a value on the finest of two or three systematic meshes is from that of an infinitely fine one:
/// observed order, Richardson extrapolation and grid convergence index (GCI). Meshes are systematic if all
/// their cells have shrunk by the same ratio. Sources: Roache, J. Fluids Eng. 116 (1994) 405; Celik et al.,
/// J. Fluids Eng. 130 (2008) 078001, for unequal ratios.
#pragma once

#include <string>
#include <vector>

namespace pipelines {

/// One mesh of the series.
struct MeshValue {
  double size = 0;   ///< size of its cells, (volume / number of cells)^(1/3); any unit, > 0
  double value = 0;  ///< value that was found on it
};

/// Indices 1, 2, 3: the finest mesh, the next one, the coarsest (f1, r21 = h2 / h1 in the papers).
struct GridConvergence {
  int n_meshes = 0;
  double ratio_21 = 0, ratio_32 = 0;  ///< ratios of cell sizes; ratio_32 with three meshes only
  double observed_order = 0;          ///< with three meshes only
  double order = 0;         ///< order that the index takes: the observed one, but at most the formal one
  double extrapolated = 0;  ///< Richardson's value, by the observed order
  double safety = 0;        ///< 1.25 with three meshes, 3 with two
  double index_21 = 0;      ///< GCI of the finest mesh, in the value's unit
  double index_32 = 0;      ///< GCI of the next one
  /// GCI_32 / (r21^p GCI_21), both relative to their own value, with the observed order p. That order fits
  /// both changes, so the ratio differs from 1 by what the values themselves differ: by the terms of higher
  /// order.
  double asymptotic_ratio = 0;
  std::string refusal;  ///< why the index means nothing; empty: it does

  bool usable() const noexcept { return refusal.empty(); }
};

/// Grid convergence index of two or three meshes. With three meshes it is refused unless the values change in
/// one direction, by an order from 0.5 to twice the formal one (recovered stress may do better than its
/// cells, a change that vanishes by chance does not count), and the asymptotic ratio is within 10 % of 1.
/// With two meshes the formal order is believed. Values that agree to rounding (1e-10) have the index 0.
/// @param meshes        two or three, coarsest first, each with cells at least 1.05 times smaller than the
/// one before
/// @param formal_order  order of the value's error with the cell size: the polynomial degree for stress; > 0
/// @throws std::invalid_argument for another number of meshes, or sizes that do not shrink
GridConvergence grid_convergence(const std::vector<MeshValue>& meshes, double formal_order);

}  // namespace pipelines
