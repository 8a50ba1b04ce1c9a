/// A body's .msh as gmsh reads it back, so that the tests judge the file and not the program's own tables.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"

struct MeshFile {
  struct Hex {
    std::array<int, 8> nodes{};
    int group = 0;
  };
  struct Quad {
    std::array<int, 4> nodes{};
    int group = 0;
  };
  std::vector<std::array<double, 3>> points;
  std::vector<Hex> hexes;
  std::vector<Quad> quads;
  std::map<int, std::string> volume_names, boundary_names;

  double x(int node) const { return points[node][0]; }
  double y(int node) const { return points[node][1]; }
  double z(int node) const { return points[node][2]; }
};

/// Writes the body and reads it back.
/// @throws std::runtime_error if gmsh cannot read it, or if it holds anything but linear hexahedra and
/// quadrangles
MeshFile read_mesh_file(const meshes::BodyMesh& body);

/// The bytes of its file.
std::string msh_bytes(const meshes::BodyMesh& body);

/// Volume and its first moments (x, y, z) of the trilinear cells; exact up to rounding.
std::array<double, 4> volume_and_moments(const MeshFile& mesh);

/// Area and first moments (x, y) of a flat face normal to z.
std::array<double, 3> area_and_moments(const MeshFile& mesh, const std::array<int, 4>& nodes);
