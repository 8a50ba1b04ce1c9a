/// Node order of VTK's cells of degree 1 to 3, from the tensor-product order of a set of n x n (x n) nodes, n
/// = degree + 1. Lexicographic numbering: the node (i, j, k) has the number i + n j + n n k, x fastest.
///   vtk_node[v] = lexicographic_node[table[v]]
/// A test compares the tables with VTK's own parametric coordinates.
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

/// VTK_HEXAHEDRON and VTK_QUAD.
inline constexpr std::array<int, 8> vtk_linear_hexahedron_from_lexicographic = {0, 1, 3, 2, 4, 5, 7, 6};
inline constexpr std::array<int, 4> vtk_linear_quad_from_lexicographic = {0, 1, 3, 2};

/// VTK_LAGRANGE_HEXAHEDRON of degree 3, in the order of VTK 9.1 (file version 2.2).
inline constexpr std::array<int, 64> vtk_cubic_hexahedron_from_lexicographic = {
    0,  3,  15, 12, 48, 51, 63, 60,   // corners
    1,  2,  7,  11, 13, 14, 4,  8,    // edges of z = 0
    49, 50, 55, 59, 61, 62, 52, 56,   // edges of z = 1
    16, 32, 19, 35, 31, 47, 28, 44,   // edges along z
    20, 24, 36, 40, 23, 27, 39, 43,   // faces x = 0, x = 1
    17, 18, 33, 34, 29, 30, 45, 46,   // faces y = 0, y = 1
    5,  6,  9,  10, 53, 54, 57, 58,   // faces z = 0, z = 1
    21, 22, 25, 26, 37, 38, 41, 42};  // inside

/// VTK_LAGRANGE_QUADRILATERAL of degree 3.
inline constexpr std::array<int, 16> vtk_cubic_quad_from_lexicographic = {0,  3,  15, 12, 1, 2, 7, 11,
                                                                          13, 14, 4,  8,  5, 6, 9, 10};

/// The table of a hexahedron, (degree + 1)^3 entries.
/// @param degree  1 to 3
constexpr const int* vtk_hexahedron_order(int degree) {
  return degree == 1   ? vtk_linear_hexahedron_from_lexicographic.data()
         : degree == 2 ? vtk_hexahedron_from_lexicographic.data()
                       : vtk_cubic_hexahedron_from_lexicographic.data();
}

/// The table of its faces, (degree + 1)^2 entries.
constexpr const int* vtk_quad_order(int degree) {
  return degree == 1   ? vtk_linear_quad_from_lexicographic.data()
         : degree == 2 ? vtk_quad_from_lexicographic.data()
                       : vtk_cubic_quad_from_lexicographic.data();
}

}  // namespace fem
