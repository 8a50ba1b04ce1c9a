/// The .msh of a body of quadratic tetrahedra as gmsh reads it back.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"

struct TetrahedraFile {
  double volume_m3 = 0;                     ///< by gmsh's own Jacobians and quadrature
  std::map<std::string, double> volume_of;  ///< by volume group
  std::map<std::string, double> area_of;    ///< by boundary group
  std::map<std::string, std::vector<std::array<double, 3>>>
      nodes_of;                    ///< of boundary groups, all six of each face
  std::map<std::string, int> ids;  ///< of all groups
};

/// @throws std::runtime_error if gmsh cannot read it, or if it holds anything but tetrahedra of 10 nodes and
/// triangles of 6
TetrahedraFile read_tetrahedra(const std::filesystem::path& file);
TetrahedraFile read_tetrahedra(const meshes::BodyMesh& body);

/// What n parabolas through three points of the circle each leave of its area, relative: (pi/n)^4 / 30.
double lost_by_parabolas(int n);

/// Words that the exception of an action must have; "accepted" if it throws none.
template <typename Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

void expect_words(const std::string& text, const std::vector<std::string>& words);
