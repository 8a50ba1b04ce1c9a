#include "meshes/imported/imported.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "meshes/checks/affordable.h"
#include "meshes/checks/curved_quality.h"
#include "meshes/checks/reentrant_edges.h"
#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/apart.h"
#include "meshes/imported/file_checks.h"
#include "meshes/imported/model_bytes.h"
#include "meshes/imported/port_selection.h"
#include "meshes/solids/cell_estimate.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

// Seconds of a core before gmsh is taken to hang: ten times what sound files take
// (tests/unit/meshes/imported).
constexpr double least_reading_s = 4, s_per_byte = 4e-6;
constexpr double least_meshing_s = 4, s_per_cell = 2e-3;

enum class Format { step, msh };

Format format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
  if (extension == ".step" || extension == ".stp") return Format::step;
  if (extension == ".msh") return Format::msh;
  throw GeometryRefused("must be a .step, .stp or .msh file");
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

std::string text_of(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw GeometryRefused("is no file; check the path");
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw GeometryRefused("cannot be read; check its permissions");
  return text;
}

/// In the child: gmsh prints what it is at, which is all that is known if it crashes.
ModelMesh load_with_gmsh(const Import& import, double scale_to_m) {
  const GmshSession session;
  gmsh::option::setNumber("General.Terminal", 1);
  gmsh::option::setNumber("General.Verbosity", 4);
  gmsh::option::setNumber("General.NumThreads", 1);
  if (format_of(import.geometry) == Format::msh) {
    gmsh::open(import.geometry.string());
    set_order_of_cells();
    return collect_model(scale_to_m);
  }
  import_solids(import.geometry);
  const double n_cells = estimated_cells(import.control, scale_to_m);
  require_affordable(n_cells, bytes_per_tetrahedron, control_of_cells(import.control),
                     "make the cells larger, or the fine parts fewer");
  limit_rest_apart(import.time_limit_s > 0 ? import.time_limit_s : least_meshing_s + n_cells * s_per_cell);
  return mesh_and_collect(import.control, scale_to_m);
}

/// What gmsh was at when it ended: the last line of its log that says so.
std::string last_deed(const std::string& log) {
  std::string deed;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    for (const char* word : {"Meshing curve", "Meshing surface", "Meshing volume", "Meshing 1D", "Meshing 2D",
                             "Meshing 3D", "Meshing order"})
      if (const auto at = line.find(word); at != std::string::npos && line.find("Done") == std::string::npos)
        deed = line.substr(at + 8, line.find('(', at) == std::string::npos ? std::string::npos
                                                                           : line.find('(', at) - at - 9);
  return deed.empty() ? "while reading it" : "while meshing " + deed;
}

[[noreturn]] void refuse_end(const EndApart& end) {
  const std::string where = last_deed(end.log);
  switch (end.kind) {
    case EndApart::Kind::too_slow:
      throw GeometryRefused("gmsh did not come to an end " + where +
                            ": repair the geometry there and export it again, or give it longer with "
                            "time_limit in the table mesh");
    case EndApart::Kind::too_large:
      throw GeometryRefused("gmsh ran out of memory " + where +
                            ": make the cells larger, or the part simpler");
    default:
      throw GeometryRefused("gmsh crashed " + where + " (" +
                            (end.signal == 0 ? "it ended itself" : strsignal(end.signal)) +
                            "): repair the geometry there and export it again");
  }
}

/// The mesh of the file; whatever gmsh does with it, this process goes on.
ModelMesh load_apart(const Import& import, double scale_to_m) {
  const std::string text = text_of(import.geometry);
  format_of(import.geometry) == Format::step ? check_step_text(text) : check_msh_text(text);
  const double reading_s =
      import.time_limit_s > 0 ? import.time_limit_s : least_reading_s + s_per_byte * double(text.size());
  const auto end =
      run_apart([&] { return bytes_of([&] { return load_with_gmsh(import, scale_to_m); }); }, reading_s);
  if (end.kind != EndApart::Kind::finished) refuse_end(end);
  return model_from(end.result);
}

/// Names of the file's groups become names of features, in tables and files.
void check_group_names(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces) {
    const std::string& name = piece.name;
    const bool is_printed = std::none_of(name.begin(), name.end(),
                                         [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '"'; });
    if (!is_printed || (!name.empty() && std::string("=+-@").find(name[0]) != std::string::npos))
      throw GeometryRefused("the name of its physical group " + std::to_string(piece.tag) +
                            " holds quotes or control characters, or begins with = + - or @, which a "
                            "spreadsheet takes for a formula; rename it");
  }
}

ModelMesh load(const Import& import, double scale_to_m) {
  ModelMesh model = load_apart(import, scale_to_m);
  if (const int n = n_separate_parts(model.mesh); n > 1)
    throw GeometryRefused("it has " + std::to_string(n) +
                          " parts that do not touch: join them, or import one");
  check_group_names(model.pieces);
  check_group_names(model.volumes);
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

/// What it throws does not name the file.
BodyMesh build_unnamed(const Import& import, const std::filesystem::path& file) {
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

}  // namespace

BodyMesh build_imported(const Import& import, const std::filesystem::path& file) {
  const std::string name = "the geometry " + import.geometry.string() + ": ";
  try {
    return build_unnamed(import, file);
  } catch (const TooManyCells& error) {
    throw TooManyCells(error.control(), name + error.what());
  } catch (const GeometryRefused& error) {
    throw GeometryRefused(name + error.what());
  } catch (const MeshRefused& error) {
    throw MeshRefused(name + error.what());
  }
}

}  // namespace meshes
