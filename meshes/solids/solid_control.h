/// How solids that are not made of blocks are meshed: with quadratic tetrahedra by Delaunay on one thread, so
/// that the same solid gives the same bytes.
#pragma once

#include <array>
#include <vector>

namespace meshes {

/// A ball in which edges are short; outside they grow with the distance.
struct FineSpot {
  std::array<double, 3> centre_m{};
  double radius_m = 0;
  double size_m = 0;  ///< edge length inside
};

struct SolidControl {
  double size_m = 0;       ///< longest edge wanted; 0: a 20th of the body's diagonal
  double size_factor = 1;  ///< factor of size_m, given or not
  /// No edges are shorter, whatever curvature asks for: limits what small fillets cost; 0: from the sizes of
  /// the part (cell_estimate.h).
  double smallest_size_m = 0;
  /// Cells around every curved surface, >= 6; a quarter of a fillet gets a fourth of it.
  int cells_per_circle = 16;
  /// Least scaled Jacobian of the curved cells; below it the mesh is refused.
  double min_scaled_jacobian = 0.05;
  std::vector<FineSpot> fine_spots{};
  /// No stress is reported closer to re-entrant edges. 0: 1 % of the body's size, at most volume over surface
  /// (reentrant_edges.h); at a keyed shaft's shoulders as block meshes.
  double exclusion_m = 0;
};

/// @throws GeometryRefused naming the value that is out of range
void check_control(const SolidControl& control);

/// Longest edge wanted in gmsh's current model, in its unit.
/// @param unit_m  length of that unit
double longest_edge(const SolidControl& control, double unit_m);

/// Meshes the volumes of gmsh's current model, as imported or built: second order with the nodes on the
/// surfaces.
/// @param unit_m  length of the model's unit
void mesh_solids(const SolidControl& control, double unit_m);

}  // namespace meshes
