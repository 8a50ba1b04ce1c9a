/// Node order of VTK's quadratic cells, from the tensor-product order of a 3 x 3 (x 3) set of nodes.
/// Lexicographic numbering: the node at the parametric point (i/2, j/2, k/2) has the number i + 3 j + 9 k, x
/// fastest.
///   vtk_node[v] = lexicographic_node[table[v]]
/// A test compares both tables with VTK's own parametric coordinates.
#pragma once

#include <array>

namespace fem {

/// VTK_TRIQUADRATIC_HEXAHEDRON.
inline constexpr std::array<int, 27> vtk_hexahedron_from_lexicographic = {
    0,  2,  8,  6,  18, 20, 26, 24,  // corners: z = 0, then z = 1, each counter-clockwise seen from +z
    1,  5,  7,  3,                   // edges of z = 0
    19, 23, 25, 21,                  // edges of z = 1
    9,  11, 17, 15,                  // edges along z
    12, 14, 10, 16, 4,  22,          // faces x = 0, x = 1, y = 0, y = 1, z = 0, z = 1
    13};                             // centre

/// VTK_BIQUADRATIC_QUAD: corners counter-clockwise, edges y = 0, x = 1, y = 1, x = 0, centre.
inline constexpr std::array<int, 9> vtk_quad_from_lexicographic = {0, 2, 8, 6, 1, 5, 7, 3, 4};

}  // namespace fem
