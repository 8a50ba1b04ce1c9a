/// Bodies of the user's own: a solid from a STEP file, meshed with quadratic tetrahedra, or a finished .msh.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "meshes/imported/import.h"
#include "meshes/solids/solid_control.h"
#include "meshes/values/body_mesh.h"

namespace meshes {

/// STEP: solids that touch are one body. A .msh keeps its cells:
/// tetrahedra are raised to second order, hexahedra lowered to first; its groups of surfaces are features,
/// its groups of volumes regions if there are several. Every boundary face belongs to one feature: that of a
/// port, or of its group, or "hole d 12 mm (surface <n>)" as far as its shape is known, n the surface's
/// number in the CAD. Sharp edges: where faces meet at more than 60 degrees re-entrant. One call at a time in
/// a process: gmsh is global. The file's text is checked first (file_checks.h); gmsh reads and meshes it in a
/// process of its own, with limits of time and memory (apart.h), so that a file that makes it crash or hang
/// is refused like any other.
/// @throws GeometryRefused naming file or port and the remedy: a file that is missing, cannot be read
/// or has no solid, solids that do not touch, a port without surfaces (what there is, is listed), a surface
/// that two ports claim, a seat or bore that is no cylinder, a surface that sticks out of the range of z
/// @throws TooManyCells before anything is meshed, if memory cannot hold the cells asked for
/// @throws MeshRefused if the worst cell is below control.min_scaled_jacobian
BodyMesh build_imported(const Import& import);

/// What a STEP file tells before it is meshed.
struct ImportOutline {
  double volume_m3 = 0;  ///< volume of the CAD solid
  double n_cells = 0;    ///< cells that the control asks for (cell_estimate.h)
};

/// @throws as build_imported, of what is wrong with the file or the control, and of ports that no surface can
/// belong to (port_outline.h)
ImportOutline outline_imported(const Import& import);

}  // namespace meshes
