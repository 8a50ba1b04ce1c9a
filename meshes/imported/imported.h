/// Bodies of the user's own: a solid from a STEP file, meshed with quadratic tetrahedra, or a finished .msh.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "meshes/solids/solid_control.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// All surfaces of a physical group of the .msh (STEP has none).
struct GroupSelection {
  std::string name;
};

/// All surfaces whose vertices lie in the box.
struct BoxSelection {
  std::array<double, 3> low_m{}, high_m{};
};

/// All surfaces on the cylinder parallel to z that is nearest in axis and radius (within 2 % of the radius)
/// and lies in the range of z.
struct CylinderSelection {
  enum class Side { outside, inside };  ///< the outside of a shaft, the inside of a hole
  double axis_x_m = 0, axis_y_m = 0, radius_m = 0;
  double begin_m = 0, end_m = 0;
  Side side = Side::outside;
};

struct ImportPort {
  std::string name;
  Port::Kind kind = Port::Kind::seat;  ///< seats and bores must be cylinders parallel to z
  std::variant<GroupSelection, BoxSelection, CylinderSelection> selection;
};

struct Import {
  std::filesystem::path geometry;  ///< .step, .stp, or .msh of any version
  double scale_to_m = 0;           ///< length of the file's unit; 0: 1e-3 for STEP (mm), 1 for .msh
  std::vector<ImportPort> ports;
  SolidControl control;  ///< for a .msh only min_scaled_jacobian and exclusion_m count
};

/// Writes `file` (through a temporary name). STEP: solids that touch are one body. A .msh keeps its cells:
/// tetrahedra are raised to second order, hexahedra lowered to first; its groups of surfaces are features,
/// its groups of volumes regions if there are several. Every boundary face belongs to one feature: that of a
/// port, or of its group, or "surface <n>", n the surface's number in the CAD. Sharp edges: where faces meet
/// at more than 60 degrees re-entrant. One call at a time in a process: gmsh is global.
/// @throws GeometryRefused naming file or port and the remedy: a file that is missing, cannot be read
/// or has no solid, solids that do not touch, a port without surfaces (what there is, is listed), a surface
/// that two ports claim, a seat or bore that is no cylinder, a surface that sticks out of the range of z
/// @throws MeshRefused if the worst cell is below control.min_scaled_jacobian, or the file cannot be
/// written
BodyMesh build_imported(const Import& import, const std::filesystem::path& file);

}  // namespace meshes
