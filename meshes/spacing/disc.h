/// The O-grid that fills the core of the shaft: a square of cells, rounded, and rings from it to the circle.
#pragma once

#include <array>
#include <vector>

namespace meshes {

/// Cells of the unit disc. The first n_sectors points lie on the circle, at angles of 2 pi j / n_sectors.
struct Disc {
  int n_sectors = 0;
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise
};

/// @param n_sectors a multiple of 4, >= 8: the square has n_sectors / 4 cells a side, its corners on the axes
/// @param subdivisions as in ShaftMeshControl
Disc build_disc(int n_sectors, int subdivisions = 1);

}  // namespace meshes
