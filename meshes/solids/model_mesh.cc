#include "meshes/solids/model_mesh.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "meshes/checks/curved_quality.h"
#include "meshes/checks/reentrant_edges.h"
#include "meshes/solids/cad_surfaces.h"
#include "meshes/solids/cell_estimate.h"
#include "meshes/solids/inner_nodes.h"
#include "meshes/solids/straight_edges.h"
#include "meshes/values/constants.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

/// The groups of each entity of a dimension: entities of the same ones are one piece, and so is each that is
/// in none.
class Groups {
public:
  explicit Groups(int dimension) : dimension_(dimension) {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, dimension);
    for (const auto& group : groups) {
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
      for (const int entity : entities) groups_of_[entity].push_back(group.second);
    }
  }
  bool are_several(int entity) const {
    const auto groups = groups_of_.find(entity);
    return groups != groups_of_.end() && groups->second.size() > 1;
  }
  /// Place of an entity's groups in `pieces`, added at its first call.
  int place(int entity) {
    const auto groups = groups_of_.find(entity);
    const bool in_group = groups != groups_of_.end();
    const auto [known, is_new] = places_.emplace(
        std::pair(in_group, in_group ? groups->second : std::vector{entity}), int(pieces.size()));
    if (is_new) {
      Piece piece;
      piece.tag = known->first.second.front();
      if (in_group) take_names(groups->second, piece);
      pieces.push_back(piece);
    }
    return known->second;
  }
  std::vector<Piece> pieces;

private:
  void take_names(const std::vector<int>& groups, Piece& piece) const {
    for (const int group : groups) {
      std::string name;
      gmsh::model::getPhysicalName(dimension_, group, name);
      if (name.empty()) continue;
      piece.name += (piece.name.empty() ? "" : " + ") + name;
      piece.groups.push_back(name);
    }
  }

  int dimension_;
  std::map<int, std::vector<int>> groups_of_;
  std::map<std::pair<bool, std::vector<int>>, int> places_;
};

CellKind kind_of_cells() {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  if (types.empty()) throw GeometryRefused("it has no cells: mesh the volumes, or give a solid");
  if (types.size() > 1 || (types[0] != gmsh_tetrahedron_10 && types[0] != gmsh_hexahedron)) {
    std::string names;
    for (const int type : types) {
      std::string name;
      int dimension, order, n_nodes, n_primary;
      std::vector<double> coordinates;
      gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_primary);
      names += (names.empty() ? "" : ", ") + name;
    }
    throw GeometryRefused("its cells are " + names +
                          ": all must be tetrahedra, or all hexahedra; mesh it again");
  }
  return types[0] == gmsh_hexahedron ? CellKind::hexahedra : CellKind::tetrahedra;
}

/// Numbers nodes in the order of their first use.
class Nodes {
public:
  explicit Nodes(double unit_m) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    for (std::size_t i = 0; i < tags.size(); ++i)
      position_[tags[i]] = {unit_m * coordinates[3 * i], unit_m * coordinates[3 * i + 1],
                            unit_m * coordinates[3 * i + 2]};
  }
  int number(std::size_t tag, CellMesh& mesh) {
    const auto [known, is_new] = numbers_.emplace(tag, int(mesh.points.size()));
    if (is_new) mesh.points.push_back(position_.at(tag));
    return known->second;
  }
  /// Number of the node with that tag; -1: it is of no cell.
  int known(std::size_t tag) const {
    const auto found = numbers_.find(tag);
    return found == numbers_.end() ? -1 : found->second;
  }

private:
  std::map<std::size_t, Point> position_;
  std::map<std::size_t, int> numbers_;
};

using Corners = std::array<int, 4>;  // ascending; the first -1 for triangles
Corners corners_of(const int* face, std::size_t n_corners) {
  Corners corners = {-1, -1, -1, -1};
  std::copy_n(face, n_corners, corners.begin());
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Turns a cell inside out by changing the places of nodes.
void turn(CellKind kind, int* nodes) {
  if (kind == CellKind::tetrahedra) {
    std::swap(nodes[0], nodes[1]);
    std::swap(nodes[5], nodes[6]);
    std::swap(nodes[7], nodes[9]);
  } else {
    for (int i = 0; i < 4; ++i) std::swap(nodes[i], nodes[i + 4]);
  }
}

bool is_inside_out(const CellMesh& mesh, const int* nodes) {
  const bool tetrahedron = mesh.kind == CellKind::tetrahedra;
  const Point &o = mesh.points[nodes[0]], &a = mesh.points[nodes[1]],
              &b = mesh.points[nodes[tetrahedron ? 2 : 3]], &c = mesh.points[nodes[tetrahedron ? 3 : 4]];
  double m[3][3];
  for (int d = 0; d < 3; ++d) {
    m[0][d] = a[d] - o[d];
    m[1][d] = b[d] - o[d];
    m[2][d] = c[d] - o[d];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
         0;
}

void collect_cells(Nodes& nodes, Groups& volumes, CellMesh& mesh) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 3);
  for (const auto& entity : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, its_nodes;
    gmsh::model::mesh::getElements(types, tags, its_nodes, 3, entity.second);
    std::set<std::vector<std::size_t>> known;
    for (std::size_t t = 0; t < types.size(); ++t)
      for (std::size_t e = 0; e < tags[t].size(); ++e) {
        const std::size_t n = mesh.nodes_per_cell();
        // Version 2.2 writes a cell once for each of its groups.
        if (volumes.are_several(entity.second)) {
          std::vector<std::size_t> corners(&its_nodes[t][n * e], &its_nodes[t][n * e] + n);
          std::sort(corners.begin(), corners.end());
          if (!known.insert(corners).second) continue;
        }
        for (std::size_t i = 0; i < n; ++i) mesh.cells.push_back(nodes.number(its_nodes[t][n * e + i], mesh));
        mesh.volume_id.push_back(volumes.place(entity.second));
        int* own = mesh.cells.data() + mesh.cells.size() - n;
        if (is_inside_out(mesh, own)) turn(mesh.kind, own);
      }
  }
}

/// Surface entity of every face that lies on one.
std::map<Corners, int> surface_of_faces(const Nodes& nodes, std::size_t n_corners) {
  std::map<Corners, int> surface;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 2);
  for (const auto& entity : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, its_nodes;
    gmsh::model::mesh::getElements(types, tags, its_nodes, 2, entity.second);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t n = tags[t].empty() ? 0 : its_nodes[t].size() / tags[t].size();
      for (std::size_t e = 0; e < tags[t].size(); ++e) {
        int corners[4];
        for (std::size_t i = 0; i < n_corners && i < n; ++i)
          corners[i] = nodes.known(its_nodes[t][n * e + i]);
        if (n >= n_corners) surface[corners_of(corners, n_corners)] = entity.second;
      }
    }
  }
  return surface;
}

void collect_faces(const std::map<Corners, int>& surface, Groups& groups, CellMesh& mesh) {
  std::map<Corners, int> count;
  const auto for_each_face = [&](const auto& handle) {
    for (std::size_t c = 0; c < mesh.n_cells(); ++c)
      for (const auto& local : local_faces(mesh.kind)) {
        std::vector<int> face;
        for (const int i : local) face.push_back(mesh.cell(c)[i]);
        handle(face, corners_of(face.data(), mesh.corners_per_face()));
      }
  };
  for_each_face([&](const auto&, const Corners& corners) { ++count[corners]; });
  for_each_face([&](const auto& face, const Corners& corners) {
    if (count[corners] > 1) return;
    mesh.faces.insert(mesh.faces.end(), face.begin(), face.end());
    const auto found = surface.find(corners);
    mesh.face_id.push_back(groups.place(found == surface.end() ? 0 : found->second));
  });
}

/// OpenCASCADE is off by 1e-3 of the area and the size of splines; where the curves around them tell another
/// area than that, its own stays.
void take_exact_centre(Piece& piece) {
  constexpr double same_area = 1e-2;
  std::string type;
  gmsh::model::getType(2, piece.tag, type);
  if (type == "Plane" || type == "Cylinder") return;  // exact
  const auto exact = area_of(piece.tag, recognise(piece.tag));
  if (!exact || !(std::abs(exact->area - piece.size) < same_area * piece.size)) return;
  piece.size = exact->area;
  piece.centre_m = exact->centre;
}

/// Measures surfaces or volumes that OpenCASCADE has.
void measure(int dimension, double unit_m, std::vector<Piece>& pieces) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  if (!groups.empty()) return;
  for (auto& piece : pieces) {
    if (piece.tag == 0) continue;
    gmsh::model::occ::getMass(dimension, piece.tag, piece.size);
    gmsh::model::occ::getCenterOfMass(dimension, piece.tag, piece.centre_m[0], piece.centre_m[1],
                                      piece.centre_m[2]);
    std::vector<double> inertia;  // 3 x 3, about the centre
    gmsh::model::occ::getMatrixOfInertia(dimension, piece.tag, inertia);
    piece.second_moment = (inertia[0] + inertia[4] + inertia[8]) / 2 * std::pow(unit_m, dimension + 2);
    if (dimension == 2) take_exact_centre(piece);
    piece.size *= std::pow(unit_m, dimension);
    for (double& x : piece.centre_m) x *= unit_m;
  }
}

bool are_measured(const std::vector<Piece>& pieces) {
  return std::all_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.size > 0; });
}

BodySize size_of_cad(const ModelMesh& model) {
  BodySize size;
  for (const auto& surface : model.pieces) size.area_m2 += surface.size;
  Point centre{};
  for (const auto& volume : model.volumes) {
    size.volume_m3 += volume.size;
    for (int d = 0; d < 3; ++d) centre[d] += volume.size * volume.centre_m[d];
  }
  for (double& x : centre) x /= size.volume_m3;
  for (const auto& volume : model.volumes) {
    const double beside = std::hypot(volume.centre_m[0] - centre[0], volume.centre_m[1] - centre[1],
                                     volume.centre_m[2] - centre[2]);
    size.second_moment_m5 += volume.second_moment + volume.size * beside * beside;
  }
  return size;
}

/// Size of the body within the flat faces between the corners.
BodySize size_of_mesh(const CellMesh& mesh) {
  std::vector<std::array<Point, 3>> surface;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    for (std::size_t half = 0; half + 2 < mesh.corners_per_face(); ++half) {
      const int* nodes = mesh.face(f);
      surface.push_back({mesh.points[nodes[0]], mesh.points[nodes[half + 1]], mesh.points[nodes[half + 2]]});
    }
  return size_within(surface);
}

/// One mesh, as good as moves of its nodes make it.
ModelMesh mesh_once(const SolidControl& control, double unit_m) {
  constexpr double easily_reached = 0.15, hardly_reached = 0.3;  // the median is 0.6
  mesh_solids(control, unit_m);
  auto model = collect_model(unit_m);
  model.smallest_size_m = unit_m * smallest_edge(control, unit_m);
  measure(2, unit_m, model.pieces);
  measure(3, unit_m, model.volumes);
  const double wanted = std::clamp(control.min_scaled_jacobian, easily_reached, hardly_reached);
  const CellMesh curved = model.mesh;
  move_inner_nodes(model.mesh, wanted);
  if (measure_quality(model.mesh).min_scaled_jacobian >= control.min_scaled_jacobian) return model;
  // Beside a cell that no move mends, moves make others as bad: first the edges, then the nodes inside.
  model.mesh = curved;
  model.straight_edges = straighten_edges(model.mesh, control.min_scaled_jacobian);
  move_inner_nodes(model.mesh, wanted);
  return model;
}

}  // namespace

std::string name_of(const Piece& surface) {
  if (!surface.name.empty()) return surface.name;
  const std::string number = "surface " + std::to_string(surface.tag);
  return surface.shape.empty() ? number : surface.shape + " (" + number + ")";
}

ModelMesh collect_model(double unit_m) {
  ModelMesh model;
  model.mesh.kind = kind_of_cells();
  Nodes nodes(unit_m);
  Groups volumes(3), surfaces(2);
  collect_cells(nodes, volumes, model.mesh);
  collect_faces(surface_of_faces(nodes, model.mesh.corners_per_face()), surfaces, model.mesh);
  model.pieces = surfaces.pieces;
  model.volumes = volumes.pieces;
  return model;
}

ModelMesh mesh_and_collect(const SolidControl& control, double unit_m) {
  constexpr double smaller = 0.85;  // another arrangement of the cells, at 1.6 times their number
  constexpr int n_tries = 3;
  SolidControl tried = control;
  for (int i = 1;; ++i, tried.size_factor *= smaller) {
    const bool is_last = i == n_tries;
    try {
      auto model = mesh_once(tried, unit_m);
      if (is_last || measure_quality(model.mesh).min_scaled_jacobian >= least_scaled_jacobian(model, control))
        return model;
    } catch (const std::string&) {  // thrown by gmsh
      if (is_last) throw;
    } catch (const std::runtime_error&) {  // thrown by gmsh 4.9 and later
      if (is_last) throw;
    }
    gmsh::model::mesh::clear();
  }
}

double least_scaled_jacobian(const ModelMesh& model, const SolidControl& control) {
  constexpr double share_in_wedges = 0.1;
  return (model.straight_edges.empty() ? 1 : share_in_wedges) * control.min_scaled_jacobian;
}

double usual_exclusion_m(const ModelMesh& model) {
  const bool of_cad = are_measured(model.pieces) && are_measured(model.volumes);
  return usual_exclusion_m(of_cad ? size_of_cad(model) : size_of_mesh(model.mesh));
}

std::vector<int> separate_parts(const CellMesh& mesh) {
  std::vector<int> parent(mesh.n_cells());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<Corners, int> cell_of;
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    for (const auto& local : local_faces(mesh.kind)) {
      std::vector<int> face;
      for (const int i : local) face.push_back(mesh.cell(c)[i]);
      const auto [other, is_new] = cell_of.emplace(corners_of(face.data(), mesh.corners_per_face()), int(c));
      if (!is_new) parent[root(int(c))] = root(other->second);
    }
  std::map<int, int> number;  // by root
  std::vector<int> part(mesh.n_cells());
  for (std::size_t c = 0; c < mesh.n_cells(); ++c)
    part[c] = number.emplace(root(int(c)), int(number.size())).first->second;
  return part;
}

}  // namespace meshes
