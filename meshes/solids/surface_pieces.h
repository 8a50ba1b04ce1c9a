/// What the pieces of a surface look like: their extent, and the cylinder parallel to z they lie on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshes/values/cell_mesh.h"

namespace meshes {

struct FoundCylinder {
  double axis_x_m = 0, axis_y_m = 0, radius_m = 0;
  bool inside = false;  ///< a hole: the material is outside the radius
};

struct PieceShape {
  Point low_m{}, high_m{};  ///< box around its corner nodes
  Point centre_m{};         ///< centre of its area, with the curves of quadratic cells
  double area_m2 = 0;
  std::optional<FoundCylinder> cylinder;
};

/// Shapes of the pieces named by `of_face` (a number per face, as face_id). Corner nodes are within 1e-3 of
/// the radius of a cylinder that is found.
std::vector<PieceShape> shapes_of(const CellMesh& mesh, const std::vector<int>& of_face, std::size_t n);

/// The cylinder through some of the pieces together, if all of them lie on one.
std::optional<FoundCylinder> common_cylinder(const CellMesh& mesh, const std::vector<int>& of_face,
                                             const std::vector<int>& pieces);

/// "outside of radius 25 mm about (0, 0) mm, z = 10 to 40 mm"
std::string describe(const PieceShape& shape);

}  // namespace meshes
