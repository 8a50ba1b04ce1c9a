#include "meshes/imported/load_apart.h"

#include <gmsh.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "meshes/checks/affordable.h"
#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/apart.h"
#include "meshes/imported/file_checks.h"
#include "meshes/imported/model_bytes.h"
#include "meshes/imported/port_outline.h"
#include "meshes/imported/rounded_edges.h"
#include "meshes/solids/cad_surfaces.h"
#include "meshes/solids/cell_estimate.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

// Seconds of a core before gmsh is taken to hang. The samples of tests/unit/meshes/imported take 0.1 s to
// read, and 1e-4 s for each cell.
constexpr double least_reading_s = 4, s_per_byte = 4e-6;
constexpr double least_meshing_s = 4, s_per_cell = 1e-3, s_per_cell_of_small = 2e-3, most_of_small_s = 16;

double meshing_s(double n_cells) {
  return least_meshing_s +
         std::max(std::min(s_per_cell_of_small * n_cells, most_of_small_s), s_per_cell * n_cells);
}

/// A file in memory with that text, which lives as long as the process.
std::string file_in_memory(const std::string& text) {
  const int file = memfd_create("part.step", 0);
  for (std::size_t at = 0; at < text.size();) {
    const auto n = write(file, text.data() + at, text.size() - at);
    if (n <= 0) throw GeometryRefused("its text has no room in memory: make room, or the file smaller");
    at += std::size_t(n);
  }
  return "/proc/self/fd/" + std::to_string(file);
}

/// @param step  the file that is read
void import_solids(const Import& import, const std::string& step) {
  gmsh::vectorpair shapes, volumes, fragments;
  // Names and colours are not looked at, and gmsh refuses files that colour curves.
  gmsh::option::setNumber("Geometry.OCCImportLabels", 0);
  gmsh::model::occ::importShapes(step, shapes, true, "step");
  gmsh::model::occ::synchronize();
  gmsh::model::getEntities(volumes, 3);
  if (volumes.empty()) throw GeometryRefused("it has no solid, surfaces at most: export the part as a solid");
  if (volumes.size() == 1) return;
  if (import.time_limit_s == 0) limit_rest_apart(least_reading_s * double(volumes.size()));
  std::vector<gmsh::vectorpair> map;  // solids that touch share their surfaces afterwards
  gmsh::model::occ::fragment({volumes.front()}, {volumes.begin() + 1, volumes.end()}, fragments, map);
  gmsh::model::occ::synchronize();
}

/// Moves gmsh's model, if it is far from the origin against its size, about its own centre: with large
/// coordinates the same part gets other cells, some of them nearly flat.
/// @returns where the centre was, in the model's unit; zero if nothing is moved
Point move_to_origin() {
  constexpr double far = 10;  // diagonals
  double low[3], high[3];
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  const Point centre{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  if (!(std::hypot(centre[0], centre[1], centre[2]) > far * diagonal)) return {};
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::occ::translate(volumes, -centre[0], -centre[1], -centre[2]);
  gmsh::model::occ::synchronize();
  return centre;
}

void move(Point& point, const Point& by, double scale) {
  for (int d = 0; d < 3; ++d) point[d] += scale * by[d];
}

/// The largest distance of an edge's middle node from the middle of its ends, over the edge's length, and
/// where that is. Of hexahedra of second order, as gmsh numbers their nodes.
std::pair<double, Point> most_curved_edge(int type, int n_nodes) {
  constexpr int edges[12][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  std::vector<std::size_t> tags, nodes, node_tags;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getElementsByType(type, tags, nodes);
  gmsh::model::mesh::getNodes(node_tags, coordinates, parametric);
  std::unordered_map<std::size_t, std::size_t> place;
  for (std::size_t i = 0; i < node_tags.size(); ++i) place[node_tags[i]] = i;
  std::pair<double, Point> most{};
  for (std::size_t cell = 0; cell < tags.size(); ++cell) {
    const auto at = [&](int node) {
      return &coordinates[3 * place.at(nodes[cell * std::size_t(n_nodes) + std::size_t(node)])];
    };
    for (int edge = 0; edge < 12; ++edge) {
      const double *a = at(edges[edge][0]), *b = at(edges[edge][1]), *m = at(8 + edge);
      double off = 0, length = 0;
      for (int d = 0; d < 3; ++d) {
        off += std::pow(m[d] - (a[d] + b[d]) / 2, 2);
        length += std::pow(b[d] - a[d], 2);
      }
      if (length > 0 && std::sqrt(off / length) > most.first)
        most = {std::sqrt(off / length), Point{m[0], m[1], m[2]}};
    }
  }
  return most;
}

/// Hexahedra become straight. That is no small matter where few of them go around a circle: a bar loses 10 %
/// of its section with 8, 0.16 % with 64.
void require_straight_hexahedra(int type, int n_nodes) {
  constexpr double most_curved = 0.015;  // tan(pi / (2 n)) / 2 with n cells around: 53 and more
  const auto [curved, where] = most_curved_edge(type, n_nodes);
  if (curved <= most_curved) return;
  std::ostringstream text;
  text.precision(4);
  text << "its hexahedra of second order are curved by up to " << curved << " of their edges, at ("
       << where[0] << ", " << where[1] << ", " << where[2]
       << "), and would be taken for straight: mesh it with tetrahedra of second order, which keep their "
          "curves, "
          "or finer, with 54 cells and more around a circle";
  throw GeometryRefused(text.str());
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
    if (n_primary == 8 && order == 2) require_straight_hexahedra(type, n_nodes);
  }
  if (types.empty()) throw GeometryRefused("it has no cells, only a surface: mesh its volumes");
  const int wanted = tetrahedra ? 2 : 1;
  if (highest != wanted) gmsh::model::mesh::setOrder(wanted);
}

std::string text_of(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) throw GeometryRefused("is no file; check the path");
  const auto size = std::filesystem::file_size(file, none);
  if (!none && size > most_bytes_of_a_geometry)
    throw GeometryRefused("has " + std::to_string(size / 1'000'000) + " MB, and at most " +
                          std::to_string(most_bytes_of_a_geometry / 1'000'000) +
                          " are read: export the part alone, or mesh it coarser");
  std::ifstream in(file, std::ios::binary);
  std::string text(none ? 0 : size, '\0');
  if (!in.read(text.data(), std::streamsize(text.size())))
    throw GeometryRefused("cannot be read; check its permissions");
  return text;
}

/// Runs in the child: gmsh prints what it is at, which is all that is known if it crashes.
/// @param step  the file that is read, if it is STEP
ModelMesh load_with_gmsh(const Import& import, const std::string& step, double scale_to_m) {
  const GmshSession session;
  gmsh::option::setNumber("General.Terminal", 1);
  gmsh::option::setNumber("General.Verbosity", 4);
  gmsh::option::setNumber("General.NumThreads", 1);
  if (format_of(import.geometry) == GeometryFormat::msh) {
    gmsh::open(import.geometry.string());
    set_order_of_cells();
    return collect_model(scale_to_m);
  }
  import_solids(import, step);
  const auto rounded = round_edges(import.notches, scale_to_m);
  refuse_slender_tips();
  const double n_cells = estimated_cells(import.control, scale_to_m);
  require_affordable(n_cells, bytes_per_tetrahedron, control_of_cells(import.control),
                     "make the cells larger, or the fine parts fewer");
  limit_rest_apart(import.time_limit_s > 0 ? import.time_limit_s : meshing_s(n_cells));
  const Point centre = move_to_origin();
  SolidControl control = import.control;
  for (auto& spot : control.fine_spots) move(spot.centre_m, centre, -scale_to_m);
  ModelMesh model = mesh_and_collect(control, scale_to_m);
  name_shapes(scale_to_m, {scale_to_m * centre[0], scale_to_m * centre[1], scale_to_m * centre[2]}, model);
  name_notches(import.notches, rounded, model);
  for (auto& point : model.mesh.points) move(point, centre, scale_to_m);
  for (auto& edge : model.straight_edges) move(edge.middle_m, centre, scale_to_m);
  for (auto* pieces : {&model.pieces, &model.volumes})
    for (auto& piece : *pieces) move(piece.centre_m, centre, scale_to_m);
  return model;
}

/// Runs in the child: the volumes, and how many cells they would get.
ModelMesh read_with_gmsh(const Import& import, const std::string& step, double scale_to_m) {
  const GmshSession session;
  gmsh::option::setNumber("General.Terminal", 1);
  gmsh::option::setNumber("General.Verbosity", 4);
  import_solids(import, step);
  round_edges(import.notches, scale_to_m);
  refuse_slender_tips();
  require_surfaces_of_ports(import.ports, scale_to_m);
  const double n_cells = estimated_cells(import.control, scale_to_m);
  require_affordable(n_cells, bytes_per_tetrahedron, control_of_cells(import.control),
                     "make the cells larger, or the fine parts fewer");
  ModelMesh model;
  model.mesh.points.push_back({n_cells, 0, 0});
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  for (const auto& volume : volumes) {
    Piece piece;
    piece.tag = volume.second;
    piece.size = std::pow(scale_to_m, 3) * measure_of(3, volume.second);
    model.volumes.push_back(piece);
  }
  return model;
}

/// What gmsh was at when it ended: the last line of its log that says "Meshing surface 7 (Cylinder)" or so.
std::string last_deed(const std::string& log) {
  const std::string verb = "Meshing ";
  std::string deed;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    for (const char* what : {"curve", "surface", "volume", "1D", "2D", "3D", "order"})
      if (const auto at = line.find(verb + what); at != std::string::npos) {
        const auto begin = at + verb.size();
        deed = line.substr(begin, line.find_first_of("(.", begin) - begin);
        if (!deed.empty() && deed.back() == ' ') deed.pop_back();
      }
  return deed.empty() ? "while reading it" : "while meshing " + deed;
}

[[noreturn]] void refuse_end(const EndApart& end) {
  const std::string where = last_deed(end.log);
  switch (end.kind) {
    case EndApart::Kind::too_slow:
      throw GeometryRefused(
          "gmsh did not come to an end " + where +
          ": draw it more simply there (a thread or helical groove as plain grooves, a pointed "
          "end flat) and export it again, or give it longer with time_limit in the table mesh");
    case EndApart::Kind::too_late:
      throw MeshRefused("the time was up " + where);
    case EndApart::Kind::too_large:
      throw GeometryRefused("gmsh ran out of memory " + where +
                            ": make the cells larger, or the part simpler");
    default:
      throw GeometryRefused("gmsh crashed " + where + " (" +
                            (end.signal == 0 ? "it ended itself" : strsignal(end.signal)) +
                            "): repair the geometry there and export it again");
  }
}

/// Notes groups that the file has by name alone, once gmsh has read it: no piece has their names.
void note_empty_groups(const std::string& msh_text, ModelMesh& model) {
  for (auto& name : surface_groups_named(msh_text)) {
    const auto has_it = [&](const Piece& piece) {
      return std::find(piece.groups.begin(), piece.groups.end(), name) != piece.groups.end();
    };
    if (std::none_of(model.pieces.begin(), model.pieces.end(), has_it))
      model.empty_groups.push_back(std::move(name));
  }
}

}  // namespace

GeometryFormat format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
  if (extension == ".step" || extension == ".stp") return GeometryFormat::step;
  if (extension == ".msh") return GeometryFormat::msh;
  throw GeometryRefused("must be a .step, .stp or .msh file");
}

namespace {

/// Work of the child.
/// @param step  the file that is read, if it is STEP
using WorkApart = std::function<ModelMesh(const std::string& step)>;

ModelMesh model_apart(const Import& import, double scale_to_m, const WorkApart& work) {
  const std::string text = text_of(import.geometry);
  std::string to_read;
  if (format_of(import.geometry) == GeometryFormat::step) {
    to_read = step_text_to_read(text);
    check_step_unit(text, scale_to_m);
  } else {
    check_msh_text(text);
  }
  const double reading_s =
      import.time_limit_s > 0 ? import.time_limit_s : least_reading_s + s_per_byte * double(text.size());
  const auto read = [&] {
    const bool as_it_is = to_read.empty() || to_read == text;
    return work(as_it_is ? import.geometry.string() : file_in_memory(to_read));
  };
  const auto end = run_apart([&] { return bytes_of(read); }, reading_s);
  if (end.kind != EndApart::Kind::finished) refuse_end(end);
  auto model = model_from(end.result);
  if (format_of(import.geometry) == GeometryFormat::msh) note_empty_groups(text, model);
  return model;
}

}  // namespace

ModelMesh load_apart(const Import& import, double scale_to_m) {
  return model_apart(import, scale_to_m,
                     [&](const auto& step) { return load_with_gmsh(import, step, scale_to_m); });
}

ModelMesh read_apart(const Import& import, double scale_to_m) {
  return model_apart(import, scale_to_m,
                     [&](const auto& step) { return read_with_gmsh(import, step, scale_to_m); });
}

}  // namespace meshes
