#include "meshes/imported/imported.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <sstream>
#include <utility>

#include "meshes/checks/curved_quality.h"
#include "meshes/checks/quality.h"
#include "meshes/checks/reentrant_edges.h"
#include "meshes/checks/reentrant_points.h"
#include "meshes/imported/load_apart.h"
#include "meshes/imported/port_selection.h"
#include "meshes/values/refused.h"
#include "meshes/values/utf8.h"

namespace meshes {

namespace {

/// Names of the file's groups become names of features, in tables and files.
void check_group_names(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces)
    for (const std::string& name : piece.groups) {
      const bool is_printed = std::none_of(name.begin(), name.end(),
                                           [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '"'; });
      if (!is_utf8(name))
        throw GeometryRefused("the name of its physical group " + std::to_string(piece.tag) +
                              " is not written in UTF-8; rename it");
      if (!is_printed || (!name.empty() && std::string("=+-@").find(name[0]) != std::string::npos))
        throw GeometryRefused("the name of its physical group " + std::to_string(piece.tag) +
                              " holds quotes or control characters, or begins with = + - or @, which a "
                              "spreadsheet takes for a formula; rename it");
    }
}

Point middle_of_face(const CellMesh& mesh, std::size_t face) {
  Point middle{};
  for (std::size_t i = 0; i < mesh.corners_per_face(); ++i)
    for (int d = 0; d < 3; ++d)
      middle[d] += mesh.points[mesh.face(face)[i]][d] / double(mesh.corners_per_face());
  return middle;
}

/// Cells that touch in a face without sharing its nodes are not joined there: the part would have a slit that
/// nobody sees.
void require_joined_faces(const CellMesh& mesh, bool of_cad) {
  struct Face {
    double along;
    Point middle;
  };
  std::vector<Face> faces(mesh.n_faces());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Point p = middle_of_face(mesh, f);
    faces[f] = {0.61 * p[0] + 0.53 * p[1] + 0.59 * p[2],
                p};  // a direction in which hardly two faces are alike
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.along < b.along; });
  const double near_m = 1e-8 * diagonal_m(mesh);
  std::size_t n_twice = 0;
  Point where{};
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t g = f + 1; g < faces.size() && faces[g].along - faces[f].along < 2 * near_m; ++g) {
      const Point &a = faces[f].middle, &b = faces[g].middle;
      if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > near_m) continue;
      if (n_twice++ == 0) where = a;
    }
  if (n_twice == 0) return;
  std::ostringstream text;
  text.precision(4);
  text << n_twice << " faces of its cells lie on others without sharing their nodes, near (" << 1e3 * where[0]
       << ", " << 1e3 * where[1] << ", " << 1e3 * where[2] << ") mm: cells are not joined there. "
       << (of_cad ? "Let the solids overlap in the CAD and unite them, or export them as one"
                  : "Merge nodes at the same place (gmsh: Coherence Mesh), or mesh solids that share their "
                    "surfaces");
  throw GeometryRefused(text.str());
}

/// Parts that share a node or an edge of a cell, and no face, are not held together.
void require_one_part(const CellMesh& mesh, bool of_cad) {
  const auto part = separate_parts(mesh);
  const int n = part.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end());
  if (n < 2) return;
  std::vector<int> part_of_node(mesh.points.size(), -1);
  int shared = -1;
  for (std::size_t c = 0; c < mesh.n_cells() && shared < 0; ++c)
    for (std::size_t i = 0; i < mesh.nodes_per_cell(); ++i) {
      const int node = mesh.cell(c)[i];
      int& known = part_of_node[std::size_t(node)];
      if (known >= 0 && known != part[c]) shared = node;
      known = part[c];
    }
  if (shared < 0)
    throw GeometryRefused("it has " + std::to_string(n) +
                          " parts that do not touch: join them, or import one");
  const Point& at = mesh.points[std::size_t(shared)];
  std::ostringstream text;
  text.precision(4);
  text << "it has " << n << " parts that touch in a point or along a line alone, at (" << 1e3 * at[0] << ", "
       << 1e3 * at[1] << ", " << 1e3 * at[2] << ") mm, where nothing holds them together: "
       << (of_cad ? "let them overlap in the CAD and unite them" : "join them by faces of cells")
       << ", or import one";
  throw GeometryRefused(text.str());
}

/// Reach and size of the small cells around a weld's toe, in plate thicknesses: they end behind the points
/// that its stress is extrapolated from.
constexpr double fine_walls = 1.2, cell_walls = 0.35;

ModelMesh load(const Import& import, double scale_to_m) {
  ModelMesh model = load_apart(import, scale_to_m);
  const bool of_cad = format_of(import.geometry) == GeometryFormat::step;
  require_joined_faces(model.mesh, of_cad);
  require_one_part(model.mesh, of_cad);
  check_group_names(model.pieces);
  check_group_names(model.volumes);
  return model;
}

/// gmsh writes the lengths of its model, which are mm where that came from a STEP file; a .msh has no unit.
void require_likely_unit(const Import& import, const CellMesh& mesh) {
  constexpr double largest_m = 30;
  const double size_m = diagonal_m(mesh);
  if (import.scale_to_m != 0 || format_of(import.geometry) != GeometryFormat::msh || !(size_m > largest_m))
    return;
  std::ostringstream text;
  text.precision(3);
  text << "it is " << size_m
       << " m from corner to corner, since lengths of a .msh are taken for m: give length_unit, \"1 mm\" if "
          "the "
          "part is "
       << size_m << " mm large, \"1 m\" if it is that large";
  throw GeometryRefused(text.str());
}

std::string unused(std::string name, const std::set<std::string>& used) {
  while (used.count(name) > 0) name += "'";
  return name;
}

std::string name_of_volume(const Piece& volume) {
  return volume.name.empty() ? "volume " + std::to_string(volume.tag) : volume.name;
}

/// Gives cells their ids, one group per volume of the model, and says so in the body.
void name_volumes(ModelMesh& model, BodyMesh& body) {
  const bool grouped = std::any_of(model.volumes.begin(), model.volumes.end(),
                                   [](const Piece& volume) { return !volume.name.empty(); });
  for (std::size_t i = 0; i < model.volumes.size(); ++i) {
    const int id = 1 + int(i);
    body.groups.volumes[id] = name_of_volume(model.volumes[i]);
    if (grouped && model.volumes.size() > 1) body.regions.push_back({body.groups.volumes[id], {id}});
  }
  for (int& id : model.mesh.volume_id) id += 1;
}

void name_surfaces(const Import& import, ModelMesh& model, BodyMesh& body) {
  const auto shapes = shapes_of(model.mesh, model.mesh.face_id, model.pieces.size());
  const auto port_of = assign_ports(import.ports, model, shapes);
  int next_id = 1 + int(model.volumes.size());
  const auto add = [&](const std::string& name, Feature::Kind kind, double begin_m, double end_m) {
    body.groups.boundaries[next_id] = name;
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
      if (model.pieces[i].notch_radius_m > 0)
        throw GeometryRefused("port " + body.ports[std::size_t(port_of[i])].name + " has the surface of " +
                              name_of(model.pieces[i]) + ": a loaded surface is no notch; move one of them");
      id_of_piece.push_back(id_of_port[port_of[i]]);
      continue;
    }
    const Piece& piece = model.pieces[i];
    const std::string name = unused(name_of(piece), used);
    used.insert(name);
    const bool is_notch = piece.notch_radius_m > 0;
    id_of_piece.push_back(add(name, is_notch ? Feature::Kind::fillet : Feature::Kind::surface,
                              shapes[i].low_m[2], shapes[i].high_m[2]));
    if (is_notch) body.notches.push_back({id_of_piece.back(), piece.notch_radius_m, piece.notch_course_m});
  }
  for (int& id : model.mesh.face_id) id = id_of_piece[id];
}

double scale_of(const Import& import) {
  const double default_scale = format_of(import.geometry) == GeometryFormat::step ? 1e-3 : 1;
  const double scale_to_m = import.scale_to_m == 0 ? default_scale : import.scale_to_m;
  if (!std::isfinite(scale_to_m) || !(scale_to_m > 0))
    throw GeometryRefused("scale_to_m = " + std::to_string(import.scale_to_m) +
                          " must be positive: the length of the file's unit");
  return scale_to_m;
}

/// What it throws does not name the file.
BodyMesh build_unnamed(const Import& import) {
  check_control(import.control);
  const double scale_to_m = scale_of(import);
  if (!import.notches.empty() && format_of(import.geometry) != GeometryFormat::step)
    throw GeometryRefused(
        "edges are rounded for effective notch stress in STEP files only; give the part as STEP");
  ModelMesh model = load(import, scale_to_m);
  require_likely_unit(import, model.mesh);
  BodyMesh body;
  name_surfaces(import, model, body);
  name_volumes(model, body);
  body.quality = measure_quality(model.mesh);
  require_quality(
      body.quality, least_scaled_jacobian(model, import.control), "mesh",
      model.straight_edges.empty()
          ? "mesh finer there, repair the geometry, or lower min_scaled_jacobian"
          : "faces meet at a zero angle, where finer cells are flatter: make the cells larger there "
            "(size, cells_per_circle), end the faces at an angle, or lower min_scaled_jacobian");
  const double exclusion_m =
      import.control.exclusion_m > 0 ? import.control.exclusion_m : usual_exclusion_m(model);
  body.sharp_edges = reentrant_edges(model.mesh, body.groups.boundaries, exclusion_m);
  add_reentrant_points(model.mesh, body.groups.boundaries, exclusion_m, body.sharp_edges);
  for (std::size_t i = 0; i < import.welds.size(); ++i) {
    const auto toes =
        place_weld_toes(model.mesh, body.groups.boundaries, import.welds[i], int(i) + 1, body.sharp_edges);
    body.hot_spots.insert(body.hot_spots.end(), toes.hot_spots.begin(), toes.hot_spots.end());
    body.covered_toes.insert(body.covered_toes.end(), toes.covered.begin(), toes.covered.end());
  }
  body.straight_edges = std::move(model.straight_edges);
  body.smallest_size_m = model.smallest_size_m;
  body.cells = std::make_shared<const CellMesh>(std::move(model.mesh));
  return body;
}

/// What the work throws names the file.
template <typename Work>
auto with_name(const Import& import, Work&& work) {
  const std::string name = "the geometry " + import.geometry.string() + ": ";
  try {
    return work();
  } catch (const TooManyCells& error) {
    throw TooManyCells(error.control(), name + error.what());
  } catch (const GeometryRefused& error) {
    throw GeometryRefused(name + error.what());
  } catch (const MeshRefused& error) {
    throw MeshRefused(name + error.what());
  }
}

}  // namespace

BodyMesh build_imported(const Import& import) {
  return with_name(import, [&] {
    auto body = build_unnamed(import);
    if (body.hot_spots.empty() || format_of(import.geometry) != GeometryFormat::step) return body;
    // Where the welds' toes are is known by a first mesh alone.
    Import fine = import;
    for (const auto& spot : body.hot_spots)
      fine.control.fine_spots.push_back(
          {spot.toe_m, fine_walls * spot.thickness_m, cell_walls * spot.thickness_m});
    return build_unnamed(fine);
  });
}

ImportOutline outline_imported(const Import& import) {
  return with_name(import, [&] {
    check_control(import.control);
    const auto model = read_apart(import, scale_of(import));
    ImportOutline outline;
    for (const auto& volume : model.volumes) outline.volume_m3 += volume.size;
    if (!model.mesh.points.empty()) outline.n_cells = model.mesh.points.front()[0];
    return outline;
  });
}

}  // namespace meshes
