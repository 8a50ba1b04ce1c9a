/// Numbers that many files need.
#pragma once

namespace meshes {

inline constexpr double pi = 3.14159265358979323846;

/// Share of a length that rounding may blur in comparisons.
inline constexpr double tiny = 1e-9;

/// gmsh's numbers of element types.
inline constexpr int gmsh_triangle = 2, gmsh_quadrangle = 3, gmsh_tetrahedron = 4, gmsh_hexahedron = 5,
                     gmsh_triangle_6 = 9, gmsh_tetrahedron_10 = 11;

}  // namespace meshes
