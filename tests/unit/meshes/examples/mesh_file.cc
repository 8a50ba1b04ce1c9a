#include "tests/unit/meshes/examples/mesh_file.h"

#include <gmsh.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/gmsh/msh_writer.h"
#include "tests/unit/meshes/examples/example_shafts.h"

namespace {

std::map<int, std::string> names_of(int dimension) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  std::map<int, std::string> names;
  for (const auto& group : groups) gmsh::model::getPhysicalName(dimension, group.second, names[group.second]);
  return names;
}

/// Calls visit(group, nodes) for each element of a dimension, all of one expected type.
template <std::size_t n, typename Visit>
void visit_elements(int dimension, int expected_type, const std::map<std::size_t, int>& index, Visit visit) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  for (const auto& group : groups) {
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
    for (const int entity : entities) {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
      if (types != std::vector<int>{expected_type}) throw std::runtime_error("unexpected element type");
      for (std::size_t i = 0; i < nodes[0].size(); i += n) {
        std::array<int, n> element;
        for (std::size_t k = 0; k < n; ++k) element[k] = index.at(nodes[0][i + k]);
        visit(group.second, element);
      }
    }
  }
}

}  // namespace

MeshFile read_mesh_file(const meshes::BodyMesh& body) {
  const auto file = temporary_msh("read_back");
  meshes::write_msh(body, file);
  MeshFile mesh;
  meshes::with_gmsh("reading " + file.string(), [&] {
    gmsh::open(file.string());
    mesh.volume_names = names_of(3);
    mesh.boundary_names = names_of(2);
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    std::map<std::size_t, int> index;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      index[tags[i]] = static_cast<int>(i);
      mesh.points.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
    }
    visit_elements<8>(3, 5, index, [&](int group, const std::array<int, 8>& nodes) {
      mesh.hexes.push_back({nodes, group});
    });
    visit_elements<4>(2, 3, index, [&](int group, const std::array<int, 4>& nodes) {
      mesh.quads.push_back({nodes, group});
    });
  });
  std::filesystem::remove(file);
  return mesh;
}

std::string msh_bytes(const meshes::BodyMesh& body) {
  const auto file = temporary_msh("bytes");
  meshes::write_msh(body, file);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::filesystem::remove(file);
  return bytes;
}

std::array<double, 4> volume_and_moments(const MeshFile& mesh) {
  // Jacobian times coordinate is a polynomial of degree 3 in each direction at most: two Gauss points are
  // exact.
  const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
  const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::array<double, 4> sums{};
  for (const auto& hex : mesh.hexes)
    for (int point = 0; point < 8; ++point) {
      const double at[3] = {gauss[point & 1], gauss[point >> 1 & 1], gauss[point >> 2]};
      double position[3] = {}, jacobian[3][3] = {};
      for (int i = 0; i < 8; ++i) {
        double value[3], slope[3];
        for (int d = 0; d < 3; ++d) {
          value[d] = corner[i][d] ? at[d] : 1 - at[d];
          slope[d] = corner[i][d] ? 1 : -1;
        }
        for (int c = 0; c < 3; ++c) {
          const double x = mesh.points[hex.nodes[i]][c];
          position[c] += value[0] * value[1] * value[2] * x;
          jacobian[0][c] += slope[0] * value[1] * value[2] * x;
          jacobian[1][c] += value[0] * slope[1] * value[2] * x;
          jacobian[2][c] += value[0] * value[1] * slope[2] * x;
        }
      }
      const auto& j = jacobian;
      const double determinant = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                                 j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                                 j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
      sums[0] += determinant / 8;
      for (int c = 0; c < 3; ++c) sums[c + 1] += position[c] * determinant / 8;
    }
  return sums;
}

std::array<double, 3> area_and_moments(const MeshFile& mesh, const std::array<int, 4>& nodes) {
  std::array<double, 3> sums{};
  for (int i = 1; i <= 2; ++i) {  // two triangles
    const auto &a = mesh.points[nodes[0]], &b = mesh.points[nodes[i]], &c = mesh.points[nodes[i + 1]];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    sums[0] += area;
    for (int k = 0; k < 2; ++k) sums[k + 1] += area * (a[k] + b[k] + c[k]) / 3;
  }
  if (sums[0] < 0)
    for (double& sum : sums) sum = -sum;
  return sums;
}
