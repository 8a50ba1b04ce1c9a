#include "pipelines/files/vtk_files.h"

#include <vtkCellType.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "pipelines/common/errors.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/csv.h"
#include "pipelines/files/markup.h"

namespace pipelines {
namespace {

/// Values of the chosen nodes.
template <class Number>
std::vector<Number> chosen_values(const NodalField& field, const std::vector<std::int32_t>& chosen) {
  const auto n_components = std::size_t(field.n_components);
  std::vector<Number> values;
  values.reserve(chosen.size() * n_components);
  for (const std::int32_t node : chosen)
    for (std::size_t c = 0; c < n_components; ++c)
      values.push_back(static_cast<Number>(field.values[std::size_t(node) * n_components + c]));
  return values;
}

/// Neither too large, nor all lost among the smallest numbers.
bool fits_single_precision(const NodalField& field) {
  double largest = 0;
  for (std::size_t i = 0; i < field.n_values; ++i) largest = std::max(largest, std::abs(field.values[i]));
  return largest == 0 || (largest < std::numeric_limits<float>::max() &&
                          largest > 1e6 * double(std::numeric_limits<float>::min()));
}

bool is_single(const NodalField& field) {
  return field.precision == FieldPrecision::float32 && fits_single_precision(field);
}

VtuArray array_of(const NodalField& field, std::size_t n_nodes, const std::vector<std::int32_t>& chosen,
                  const VtuEncoding& encoding) {
  const auto n_components = static_cast<std::size_t>(field.n_components);
  if (field.n_components < 1 || field.n_values != n_nodes * n_components ||
      (!field.component_names.empty() && field.component_names.size() != n_components))
    throw std::invalid_argument("field \"" + field.name + "\": " + std::to_string(field.n_values) +
                                " values do not make " + std::to_string(field.n_components) +
                                " components at " + std::to_string(n_nodes) +
                                " nodes, or the names of the components are not as many");
  if (is_single(field))
    return vtu_array(field.name, chosen_values<float>(field, chosen), encoding, field.n_components,
                     field.component_names);
  return vtu_array(field.name, chosen_values<double>(field, chosen), encoding, field.n_components,
                   field.component_names);
}

}  // namespace

/// Cells of one type, the nodes of each together.
struct VtuCells {
  int type = 0;
  std::size_t n_nodes = 0;
  const std::vector<std::int32_t>& nodes;
  std::size_t size() const { return nodes.size() / n_nodes; }
};

namespace {

VtuArray array_of(const IdField& id, std::size_t n_nodes, std::size_t n_cells,
                  const std::vector<std::int32_t>& chosen, const VtuEncoding& encoding) {
  const bool at_nodes = id.at == IdField::At::nodes;
  if (id.values.size() != (at_nodes ? n_nodes : n_cells))
    throw std::invalid_argument("field \"" + id.name + "\": " + std::to_string(id.values.size()) +
                                " ids for " + std::to_string(at_nodes ? n_nodes : n_cells) +
                                (at_nodes ? " nodes" : " cells"));
  if (!at_nodes) return vtu_array(id.name, id.values, encoding);
  std::vector<std::int32_t> values;
  values.reserve(chosen.size());
  for (const std::int32_t node : chosen) values.push_back(id.values[static_cast<std::size_t>(node)]);
  return vtu_array(id.name, values, encoding);
}

}  // namespace

/// All of a file but its fields.
class EncodedCells {
public:
  /// Of the chosen nodes of the body: the cells name nodes by their place among the chosen.
  EncodedCells(const VtuCells& cells, const fem::Nodes& nodes, const std::vector<std::int32_t>& chosen,
               const std::vector<IdField>& ids, const FieldData& data, const VtuEncoding& encoding)
      : n_points_(chosen.size()),
        n_cells_(cells.size()),
        version_(cells.type == VTK_LAGRANGE_HEXAHEDRON ? "2.2" : "1.0") {
    if (nodes.xyz_m.size() != 3 * nodes.n)
      throw std::invalid_argument("nodes: " + std::to_string(nodes.xyz_m.size()) + " coordinates for " +
                                  std::to_string(nodes.n) + " nodes");
    for (const auto& list : data.names)
      field_data_.push_back(vtu_field_array(list.name, list.names, encoding));
    for (const auto& list : data.numbers)
      field_data_.push_back(vtu_field_array(list.name, list.values, encoding));
    for (const auto& id : ids)
      (id.at == IdField::At::nodes ? ids_of_nodes_ : ids_of_cells_)
          .push_back(array_of(id, nodes.n, cells.size(), chosen, encoding));
    const auto xyz = nodal_field("Points", nodes.xyz_m, 3);
    points_ = {vtu_array(xyz.name, chosen_values<double>(xyz, chosen), encoding, 3)};
    std::vector<std::int32_t> ends;
    ends.reserve(cells.size());
    for (std::size_t i = 1; i <= cells.size(); ++i) ends.push_back(std::int32_t(i * cells.n_nodes));
    cells_ = {
        vtu_array("connectivity", cells.nodes, encoding), vtu_array("offsets", ends, encoding),
        vtu_array("types", std::vector<std::uint8_t>(cells.size(), std::uint8_t(cells.type)), encoding)};
  }

  void write(const std::filesystem::path& path, const std::vector<VtuArray>& fields,
             VtuCompression compression) const {
    VtuGrid grid{
        n_points_,         n_cells_,        pointers(field_data_), pointers(fields), pointers(ids_of_cells_),
        pointers(points_), pointers(cells_)};
    grid.version = version_;
    for (const auto& id : ids_of_nodes_) grid.point_data.push_back(&id);
    write_vtu(path, grid, compression);
  }

private:
  static std::vector<const VtuArray*> pointers(const std::vector<VtuArray>& arrays) {
    std::vector<const VtuArray*> result;
    for (const auto& array : arrays) result.push_back(&array);
    return result;
  }

  std::size_t n_points_, n_cells_;
  const char* version_;
  std::vector<VtuArray> field_data_, ids_of_nodes_, ids_of_cells_, points_, cells_;
};

namespace {

std::vector<VtuArray> arrays_of(const std::vector<NodalField>& fields, std::size_t n_nodes,
                                const std::vector<std::int32_t>& chosen, const VtuEncoding& encoding) {
  std::vector<VtuArray> arrays;
  for (const auto& field : fields) arrays.push_back(array_of(field, n_nodes, chosen, encoding));
  return arrays;
}

void write_grid(const std::filesystem::path& path, const VtuCells& cells, const fem::Nodes& nodes,
                const std::vector<std::int32_t>& chosen, const std::vector<NodalField>& fields,
                const std::vector<IdField>& ids, const FieldData& data, const VtuEncoding& encoding) {
  const EncodedCells encoded(cells, nodes, chosen, ids, data, encoding);
  encoded.write(path, arrays_of(fields, nodes.n, chosen, encoding), encoding.compression);
}

int cell_type(const fem::CellShape& shape) {
  if (shape.is_tetrahedron()) return VTK_QUADRATIC_TETRA;
  return shape.degree == 1   ? VTK_HEXAHEDRON
         : shape.degree == 2 ? VTK_TRIQUADRATIC_HEXAHEDRON
                             : VTK_LAGRANGE_HEXAHEDRON;
}

int face_type(const fem::CellShape& shape) {
  if (shape.is_tetrahedron()) return VTK_QUADRATIC_TRIANGLE;
  return shape.degree == 1 ? VTK_QUAD : shape.degree == 2 ? VTK_BIQUADRATIC_QUAD : VTK_LAGRANGE_QUADRILATERAL;
}

}  // namespace

void refuse_beyond_32_bits(const std::filesystem::path& path, std::size_t n_nodes, std::size_t n_cells,
                           std::size_t nodes_per_cell) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  // By division: the product may not even fit into 64 bits.
  if (n_nodes <= most && (nodes_per_cell == 0 || n_cells <= most / nodes_per_cell)) return;
  throw FileError(path.string() + ": " + std::to_string(n_cells) + " cells of " +
                  std::to_string(nodes_per_cell) + " nodes, of " + std::to_string(n_nodes) +
                  ", are more than the indices of 32 bits in a VTK file can tell apart; take larger cells");
}

void write_envelope_vtu(const std::filesystem::path& path, const fem::Nodes& nodes,
                        const std::vector<NodalField>& fields, const std::vector<IdField>& ids,
                        const VtuEncoding& encoding, const FieldData& data) {
  refuse_beyond_32_bits(path, nodes.n, nodes.n_cells(), nodes.nodes_per_cell());
  std::vector<std::int32_t> all(nodes.n);
  std::iota(all.begin(), all.end(), 0);
  const VtuCells cells = {cell_type(nodes.shape()), nodes.nodes_per_cell(), nodes.cells};
  write_grid(path, cells, nodes, all, fields, ids, data, encoding);
}

namespace {

std::string data_array(const std::string& type, const std::string& name, int n_components,
                       const std::vector<std::string>& component_names) {
  std::string text = "      <PDataArray type=\"" + type + "\" Name=\"" + escaped(name) +
                     "\" NumberOfComponents=\"" + std::to_string(n_components) + "\"";
  for (std::size_t c = 0; c < component_names.size(); ++c)
    text += " ComponentName" + std::to_string(c) + "=\"" + escaped(component_names[c]) + "\"";
  return text + "/>\n";
}

/// What all pieces have, and where they are.
std::string joining_text(const std::vector<NodalField>& fields, const std::vector<IdField>& ids,
                         const std::vector<std::string>& pieces) {
  std::string at_nodes, at_cells, sources;
  for (const auto& field : fields)
    at_nodes += data_array(is_single(field) ? "Float32" : "Float64", field.name, field.n_components,
                           field.component_names);
  for (const auto& id : ids)
    (id.at == IdField::At::nodes ? at_nodes : at_cells) += data_array("Int32", id.name, 1, {});
  for (const auto& piece : pieces) sources += "    <Piece Source=\"" + escaped(piece) + "\"/>\n";
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PUnstructuredGrid GhostLevel=\"0\">\n"
         "    <PPointData>\n" +
         at_nodes + "    </PPointData>\n    <PCellData>\n" + at_cells + "    </PCellData>\n    <PPoints>\n" +
         data_array("Float64", "Points", 3, {}) + "    </PPoints>\n" + sources +
         "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void write_envelope_pieces(const std::filesystem::path& pvtu, const fem::Nodes& nodes,
                           const std::vector<int>& piece_of_cell, int n_pieces,
                           const std::vector<NodalField>& fields, const std::vector<IdField>& ids,
                           const VtuEncoding& encoding, const FieldData& data) {
  refuse_beyond_32_bits(pvtu, nodes.n, nodes.n_cells(), nodes.nodes_per_cell());
  const int type =
      nodes.kind == fem::CellKind::tetrahedra ? VTK_QUADRATIC_TETRA : VTK_TRIQUADRATIC_HEXAHEDRON;
  std::vector<std::string> names;
  for (int piece = 0; piece < n_pieces; ++piece) {
    std::vector<std::int32_t> place(nodes.n, -1), chosen, cells;
    auto own_ids = ids;
    for (auto& id : own_ids)
      if (id.at == IdField::At::cells) id.values.clear();
    for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
      if (piece_of_cell[c] != piece) continue;
      for (const auto node : nodes.cell(c)) place[node] = 0;
      for (std::size_t i = 0; i < ids.size(); ++i)
        if (ids[i].at == IdField::At::cells) own_ids[i].values.push_back(ids[i].values.at(c));
    }
    for (std::size_t node = 0; node < nodes.n; ++node)
      if (place[node] == 0) {
        place[node] = static_cast<std::int32_t>(chosen.size());
        chosen.push_back(static_cast<std::int32_t>(node));
      }
    for (std::size_t c = 0; c < nodes.n_cells(); ++c)
      if (piece_of_cell[c] == piece)
        for (const auto node : nodes.cell(c)) cells.push_back(place[node]);
    names.push_back(pvtu.stem().string() + "_" + std::to_string(piece) + ".vtu");
    write_grid(pvtu.parent_path() / names.back(), {type, nodes.nodes_per_cell(), cells}, nodes, chosen,
               fields, own_ids, data, encoding);
  }
  write_text_file(pvtu, joining_text(fields, ids, names));
}

SurfaceSnapshots::SurfaceSnapshots(const fem::Nodes& nodes, const std::vector<IdField>& ids,
                                   const VtuEncoding& encoding, const std::vector<NameList>& names)
    : n_nodes_(nodes.n),
      n_faces_(nodes.n_faces()),
      nodes_per_face_(nodes.nodes_per_face()),
      compression_(encoding.compression) {
  std::vector<std::int32_t> place(nodes.n, -1);
  for (const std::int32_t node : nodes.faces) place[static_cast<std::size_t>(node)] = 0;
  for (std::size_t node = 0; node < nodes.n; ++node)
    if (place[node] == 0) {
      place[node] = static_cast<std::int32_t>(chosen_.size());
      chosen_.push_back(static_cast<std::int32_t>(node));
    }
  auto faces = nodes.faces;
  for (std::int32_t& node : faces) node = place[static_cast<std::size_t>(node)];
  auto with_boundary = ids;
  with_boundary.push_back({"boundary_id", nodes.face_boundary_id, IdField::At::cells});
  cells_ =
      std::make_shared<const EncodedCells>(VtuCells{face_type(nodes.shape()), nodes.nodes_per_face(), faces},
                                           nodes, chosen_, with_boundary, FieldData{names, {}}, encoding);
}

void SurfaceSnapshots::write(const std::filesystem::path& path, const std::vector<NodalField>& fields) const {
  refuse_beyond_32_bits(path, n_nodes_, n_faces_, nodes_per_face_);
  cells_->write(path, arrays_of(fields, n_nodes_, chosen_, {compression_, 1}), compression_);
}

void write_surface_snapshot_vtu(const std::filesystem::path& path, const fem::Nodes& nodes,
                                const std::vector<NodalField>& fields, const std::vector<IdField>& ids,
                                const VtuEncoding& encoding, const std::vector<NameList>& names) {
  SurfaceSnapshots(nodes, ids, encoding, names).write(path, fields);
}

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const auto& entry : entries)
    text += "    <DataSet timestep=\"" + shortest(entry.time_s) + "\" group=\"\" part=\"0\" name=\"" +
            escaped(entry.name) + "\" file=\"" + escaped(entry.file.generic_string()) + "\"/>\n";
  write_text_file(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace pipelines
