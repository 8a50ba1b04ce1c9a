#include "meshes/imported/imported.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "meshes/checks/curved_quality.h"
#include "meshes/checks/reentrant_edges.h"
#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/port_selection.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

enum class Format { step, msh };

Format format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
  if (extension == ".step" || extension == ".stp") return Format::step;
  if (extension == ".msh") return Format::msh;
  throw GeometryRefused("the geometry " + file.string() + " must be a .step, .stp or .msh file");
}

void import_solids(const std::filesystem::path& file) {
  gmsh::vectorpair shapes, volumes, fragments;
  gmsh::model::occ::importShapes(file.string(), shapes, true, "step");
  gmsh::model::occ::synchronize();
  gmsh::model::getEntities(volumes, 3);
  if (volumes.empty()) throw GeometryRefused("it has no solid, surfaces at most: export the part as a solid");
  if (volumes.size() == 1) return;
  std::vector<gmsh::vectorpair> map;  // solids that touch share their surfaces afterwards
  gmsh::model::occ::fragment({volumes.front()}, {volumes.begin() + 1, volumes.end()}, fragments, map);
  gmsh::model::occ::synchronize();
}

/// The order the cells are written in: second for tetrahedra, first for hexahedra.
void set_order_of_cells() {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  bool tetrahedra = false;
  int highest = 1;
  for (const int type : types) {
    std::string name;
    int dimension, order, n_nodes, n_primary;
    std::vector<double> coordinates;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_primary);
    tetrahedra = tetrahedra || n_primary == 4;
    highest = std::max(highest, order);
  }
  if (types.empty()) throw GeometryRefused("it has no cells, only a surface: mesh its volumes");
  const int wanted = tetrahedra ? 2 : 1;
  if (highest != wanted) gmsh::model::mesh::setOrder(wanted);
}

ModelMesh load(const Import& import, double scale_to_m) {
  ModelMesh model;
  const std::string name = import.geometry.string();
  if (!std::filesystem::is_regular_file(import.geometry))
    throw GeometryRefused("the geometry " + name + " is no file; check the path");
  try {
    const GmshSession session;
    if (format_of(import.geometry) == Format::step) {
      import_solids(import.geometry);
      model = mesh_and_collect(import.control, scale_to_m);
    } else {
      gmsh::open(name);
      set_order_of_cells();
      model = collect_model(scale_to_m);
    }
  } catch (const std::string& message) {
    throw GeometryRefused("the geometry " + name + " cannot be read or meshed: gmsh says: " + message);
  } catch (const GeometryRefused& error) {
    throw GeometryRefused("the geometry " + name + ": " + error.what());
  }
  if (const int n = n_separate_parts(model.mesh); n > 1)
    throw GeometryRefused("the geometry " + name + " has " + std::to_string(n) +
                          " parts that do not touch: join them, or import one");
  return model;
}

std::string unused(std::string name, const std::set<std::string>& used) {
  while (used.count(name) > 0) name += "'";
  return name;
}

std::string name_of_volume(const Piece& volume) {
  return volume.name.empty() ? "volume " + std::to_string(volume.tag) : volume.name;
}

/// Gives cells their ids, one group per volume of the model, and says so in the body.
void name_volumes(ModelMesh& model, GroupNames& names, BodyMesh& body) {
  const bool grouped = std::any_of(model.volumes.begin(), model.volumes.end(),
                                   [](const Piece& volume) { return !volume.name.empty(); });
  for (std::size_t i = 0; i < model.volumes.size(); ++i) {
    const int id = 1 + int(i);
    names.volumes[id] = name_of_volume(model.volumes[i]);
    if (grouped && model.volumes.size() > 1) body.regions.push_back({names.volumes[id], {id}});
  }
  for (int& id : model.mesh.volume_id) id += 1;
}

void name_surfaces(const Import& import, ModelMesh& model, GroupNames& names, BodyMesh& body) {
  const auto shapes = shapes_of(model.mesh, model.mesh.face_id, model.pieces.size());
  const auto port_of = assign_ports(import.ports, model, shapes);
  int next_id = 1 + int(model.volumes.size());
  const auto add = [&](const std::string& name, Feature::Kind kind, double begin_m, double end_m) {
    names.boundaries[next_id] = name;
    body.features.push_back({name, kind, next_id, begin_m, end_m});
    return next_id++;
  };
  std::set<std::string> used;
  std::vector<int> id_of_port, id_of_piece;
  for (std::size_t p = 0; p < import.ports.size(); ++p) {
    const Port port = make_port(import.ports[p], model, shapes, port_of, int(p), next_id);
    using Kind = Feature::Kind;
    const Kind kinds[] = {Kind::seat, Kind::bore, Kind::surface};
    used.insert(port.name);
    id_of_port.push_back(add(port.name, kinds[int(port.kind)], port.begin_m, port.end_m));
    body.ports.push_back(port);
  }
  for (std::size_t i = 0; i < model.pieces.size(); ++i) {
    if (port_of[i] >= 0) {
      id_of_piece.push_back(id_of_port[port_of[i]]);
      continue;
    }
    const Piece& piece = model.pieces[i];
    const std::string name =
        unused(piece.name.empty() ? "surface " + std::to_string(piece.tag) : piece.name, used);
    used.insert(name);
    id_of_piece.push_back(add(name, Feature::Kind::surface, shapes[i].low_m[2], shapes[i].high_m[2]));
  }
  for (int& id : model.mesh.face_id) id = id_of_piece[id];
}

}  // namespace

BodyMesh build_imported(const Import& import, const std::filesystem::path& file) {
  check_control(import.control);
  const double default_scale = format_of(import.geometry) == Format::step ? 1e-3 : 1;
  const double scale_to_m = import.scale_to_m == 0 ? default_scale : import.scale_to_m;
  if (!std::isfinite(scale_to_m) || !(scale_to_m > 0))
    throw GeometryRefused("scale_to_m = " + std::to_string(import.scale_to_m) +
                          " must be positive: the length of the file's unit");
  ModelMesh model = load(import, scale_to_m);
  BodyMesh body;
  GroupNames names;
  body.file = file;
  body.cells = model.mesh.kind;
  name_surfaces(import, model, names, body);
  name_volumes(model, names, body);
  body.quality = measure_quality(model.mesh);
  require_quality(body.quality, import.control.min_scaled_jacobian,
                  "mesh finer there, repair the geometry, or lower min_scaled_jacobian");
  const double exclusion_m =
      import.control.exclusion_m > 0 ? import.control.exclusion_m : 0.01 * diagonal_m(model.mesh);
  body.sharp_edges = reentrant_edges(model.mesh, names.boundaries, exclusion_m);
  write_msh(model.mesh, names, file);
  return body;
}

}  // namespace meshes
