#include "tests/unit/meshes/examples/tetrahedra_file.h"

#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/gmsh/msh_writer.h"
#include "tests/unit/meshes/examples/example_shafts.h"

namespace {

double measure(int type, int entity) {
  std::vector<double> points, weights, jacobians, determinants, places;
  gmsh::model::mesh::getIntegrationPoints(type, "Gauss6", points, weights);
  gmsh::model::mesh::getJacobians(type, points, jacobians, determinants, places, entity);
  double sum = 0;
  for (std::size_t i = 0; i < determinants.size(); ++i) {
    if (!(determinants[i] > 0)) throw std::runtime_error("an element is inside out");
    sum += determinants[i] * weights[i % weights.size()];
  }
  return sum;
}

}  // namespace

TetrahedraFile read_tetrahedra(const std::filesystem::path& file) {
  TetrahedraFile read;
  meshes::with_gmsh("reading " + file.string(), [&] {
    gmsh::open(file.string());
    std::vector<std::size_t> node_tags;
    std::vector<double> xyz_m, parametric;
    gmsh::model::mesh::getNodes(node_tags, xyz_m, parametric);
    std::map<std::size_t, std::size_t> number_of;
    for (std::size_t i = 0; i < node_tags.size(); ++i) number_of[node_tags[i]] = i;
    for (const int dimension : {2, 3}) {
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups, dimension);
      for (const auto& group : groups) {
        std::string name;
        gmsh::model::getPhysicalName(dimension, group.second, name);
        read.ids[name] = group.second;
        std::vector<int> entities;
        gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
        for (const int entity : entities) {
          std::vector<int> types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
          for (std::size_t t = 0; t < types.size(); ++t) {
            if (types[t] != (dimension == 2 ? 9 : 11)) throw std::runtime_error("another type of element");
            const double size = measure(types[t], entity);
            (dimension == 2 ? read.area_of : read.volume_of)[name] += size;
            if (dimension == 3) read.volume_m3 += size;
            for (const auto node : nodes[t]) {
              const double* x = &xyz_m[3 * number_of.at(node)];
              if (dimension == 2) read.nodes_of[name].push_back({x[0], x[1], x[2]});
            }
          }
        }
      }
    }
  });
  return read;
}

TetrahedraFile read_tetrahedra(const meshes::BodyMesh& body) {
  const auto file = temporary_msh("read_back");
  meshes::write_msh(body, file);
  return read_tetrahedra(file);
}

double lost_by_parabolas(int n) {
  return std::pow(std::acos(-1.0) / n, 4) / 30;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}
