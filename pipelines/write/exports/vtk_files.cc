#include "pipelines/write/exports/vtk_files.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/write/exports/markup.h"

namespace pipelines {
namespace {

/// Values of the chosen nodes as a VTK array of T.
template <class Array>
vtkSmartPointer<Array> array_of(const double* values, int n_components,
                                const std::vector<std::int32_t>& chosen) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(chosen.size()));
  auto* into = array->GetPointer(0);
  for (const std::int32_t node : chosen)
    for (int c = 0; c < n_components; ++c)
      *into++ = static_cast<typename Array::ValueType>(values[std::size_t(node) * n_components + c]);
  return array;
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

/// VTK writes names as they are into attributes, and reads them as XML: with entities for what they have of
/// it.
void add_field(vtkUnstructuredGrid& grid, const NodalField& field, std::size_t n_nodes,
               const std::vector<std::int32_t>& chosen) {
  const auto n_components = static_cast<std::size_t>(field.n_components);
  if (field.n_components < 1 || field.n_values != n_nodes * n_components ||
      (!field.component_names.empty() && field.component_names.size() != n_components))
    throw std::invalid_argument("field \"" + field.name + "\": " + std::to_string(field.n_values) +
                                " values do not make " + std::to_string(field.n_components) +
                                " components at " + std::to_string(n_nodes) +
                                " nodes, or the names of the components are not as many");
  vtkSmartPointer<vtkDataArray> array;
  if (is_single(field))
    array = array_of<vtkFloatArray>(field.values, field.n_components, chosen);
  else
    array = array_of<vtkDoubleArray>(field.values, field.n_components, chosen);
  array->SetName(escaped(field.name).c_str());
  for (std::size_t c = 0; c < field.component_names.size(); ++c)
    array->SetComponentName(static_cast<vtkIdType>(c), escaped(field.component_names[c]).c_str());
  grid.GetPointData()->AddArray(array);
}

void add_names(vtkUnstructuredGrid& grid, const NameList& list) {
  vtkNew<vtkStringArray> array;
  array->SetName(escaped(list.name).c_str());
  for (const auto& name : list.names) array->InsertNextValue(name);
  grid.GetFieldData()->AddArray(array);
}

void add_numbers(vtkUnstructuredGrid& grid, const NumberList& list) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(escaped(list.name).c_str());
  for (const double value : list.values) array->InsertNextValue(value);
  grid.GetFieldData()->AddArray(array);
}

void add_ids(vtkDataSetAttributes& data, const std::string& name, const std::vector<std::int32_t>& values) {
  vtkNew<vtkTypeInt32Array> array;
  array->SetName(escaped(name).c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data.AddArray(array);
}

/// Cells of one type, the nodes of each together.
struct Cells {
  int type = 0;
  std::size_t n_nodes = 0;
  const std::vector<std::int32_t>& nodes;
  std::size_t size() const { return nodes.size() / n_nodes; }
};

void set_cells(vtkUnstructuredGrid& grid, const Cells& cells) {
  vtkNew<vtkTypeInt32Array> offsets, connectivity;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(cells.size()) + 1);
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(cells.nodes.size()));
  for (std::size_t i = 0; i <= cells.size(); ++i)
    offsets->SetValue(static_cast<vtkIdType>(i), static_cast<std::int32_t>(i * cells.n_nodes));
  std::copy(cells.nodes.begin(), cells.nodes.end(), connectivity->GetPointer(0));
  vtkNew<vtkCellArray> array;
  array->SetData(offsets.Get(), connectivity.Get());
  grid.SetCells(cells.type, array);
}

/// A grid of the cells given, over the chosen nodes of the body (the cells name nodes by their place among
/// the chosen).
void write_grid(const std::filesystem::path& path, const Cells& cells, const fem::Nodes& nodes,
                const std::vector<std::int32_t>& chosen, const std::vector<NodalField>& fields,
                const std::vector<IdField>& ids, const FieldData& data, VtuCompression compression) {
  if (nodes.xyz_m.size() != 3 * nodes.n)
    throw std::invalid_argument("nodes: " + std::to_string(nodes.xyz_m.size()) + " coordinates for " +
                                std::to_string(nodes.n) + " nodes");
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(array_of<vtkDoubleArray>(nodes.xyz_m.data(), 3, chosen));
  grid->SetPoints(points);
  set_cells(*grid, cells);
  for (const auto& field : fields) add_field(*grid, field, nodes.n, chosen);
  if (!fields.empty()) grid->GetPointData()->SetActiveScalars(escaped(fields.front().name).c_str());
  for (const auto& list : data.names) add_names(*grid, list);
  for (const auto& list : data.numbers) add_numbers(*grid, list);
  for (const auto& id : ids) {
    const bool at_nodes = id.at == IdField::At::nodes;
    if (id.values.size() != (at_nodes ? nodes.n : cells.size()))
      throw std::invalid_argument("field \"" + id.name + "\": " + std::to_string(id.values.size()) +
                                  " ids for " + std::to_string(at_nodes ? nodes.n : cells.size()) +
                                  (at_nodes ? " nodes" : " cells"));
    std::vector<std::int32_t> values;
    if (at_nodes)
      for (const std::int32_t node : chosen) values.push_back(id.values[static_cast<std::size_t>(node)]);
    if (at_nodes)
      add_ids(*grid->GetPointData(), id.name, values);
    else
      add_ids(*grid->GetCellData(), id.name, id.values);
  }

  AtomicFile file(path);
  bool failed = false;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&failed);
  listener->SetCallback(
      [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  // With listeners VTK prints nothing.
  writer->AddObserver(vtkCommand::ErrorEvent, listener);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  writer->SetFileName(file.temporary().c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  if (compression == VtuCompression::none)
    writer->SetCompressorTypeToNone();
  else if (compression == VtuCompression::zlib)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToLZMA();
  // A seventh of the default's time for 6 % more bytes.
  writer->SetCompressionLevel(compression == VtuCompression::zlib ? 3 : 1);
  writer->SetBlockSize(1 << 20);  // 5 % fewer bytes than by the default of 32 kB, by LZMA 20 %
  if (!writer->Write() || writer->GetErrorCode() != 0 || failed)
    throw FileError(shown(path) + ": cannot be written; check the directory and the free space");
  file.commit("</VTKFile>\n");
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
                        VtuCompression compression, const FieldData& data) {
  refuse_beyond_32_bits(path, nodes.n, nodes.n_cells(), nodes.nodes_per_cell());
  std::vector<std::int32_t> all(nodes.n);
  std::iota(all.begin(), all.end(), 0);
  const Cells cells = {cell_type(nodes.shape()), nodes.nodes_per_cell(), nodes.cells};
  write_grid(path, cells, nodes, all, fields, ids, data, compression);
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
         "    <PPointData" +
         (fields.empty() ? "" : " Scalars=\"" + escaped(fields.front().name) + "\"") + ">\n" + at_nodes +
         "    </PPointData>\n    <PCellData>\n" + at_cells + "    </PCellData>\n    <PPoints>\n" +
         data_array("Float64", "Points", 3, {}) + "    </PPoints>\n" + sources +
         "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

std::vector<std::int32_t> read_node_ids(const std::filesystem::path& vtu, const std::string& name) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(vtu.c_str())) throw FileError(vtu.string() + ": is no VTU file that can be read");
  reader->SetFileName(vtu.c_str());
  reader->UpdateInformation();
  for (int i = 0; i < reader->GetNumberOfPointArrays(); ++i)
    reader->SetPointArrayStatus(reader->GetPointArrayName(i), name == reader->GetPointArrayName(i) ? 1 : 0);
  reader->Update();
  auto* values = reader->GetOutput()->GetPointData()->GetArray(name.c_str());
  std::vector<std::int32_t> ids;
  if (values != nullptr)
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
      ids.push_back(std::int32_t(values->GetComponent(i, 0)));
  return ids;
}

void write_envelope_pieces(const std::filesystem::path& pvtu, const fem::Nodes& nodes,
                           const std::vector<int>& piece_of_cell, int n_pieces,
                           const std::vector<NodalField>& fields, const std::vector<IdField>& ids,
                           VtuCompression compression, const FieldData& data) {
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
               fields, own_ids, data, compression);
  }
  write_text_file(pvtu, joining_text(fields, ids, names));
}

SurfaceSnapshots::SurfaceSnapshots(const fem::Nodes& nodes, std::vector<IdField> ids,
                                   VtuCompression compression, std::vector<NameList> names)
    : nodes_(nodes),
      ids_(std::move(ids)),
      compression_(compression),
      names_(std::move(names)),
      faces_(nodes.faces) {
  std::vector<std::int32_t> place(nodes.n, -1);
  for (const std::int32_t node : nodes.faces) place[static_cast<std::size_t>(node)] = 0;
  for (std::size_t node = 0; node < nodes.n; ++node)
    if (place[node] == 0) {
      place[node] = static_cast<std::int32_t>(chosen_.size());
      chosen_.push_back(static_cast<std::int32_t>(node));
    }
  for (std::int32_t& node : faces_) node = place[static_cast<std::size_t>(node)];
  ids_.push_back({"boundary_id", nodes.face_boundary_id, IdField::At::cells});
}

void SurfaceSnapshots::write(const std::filesystem::path& path, const std::vector<NodalField>& fields) const {
  refuse_beyond_32_bits(path, nodes_.n, nodes_.n_faces(), nodes_.nodes_per_face());
  write_grid(path, {face_type(nodes_.shape()), nodes_.nodes_per_face(), faces_}, nodes_, chosen_, fields,
             ids_, {names_, {}}, compression_);
}

void write_surface_snapshot_vtu(const std::filesystem::path& path, const fem::Nodes& nodes,
                                const std::vector<NodalField>& fields, const std::vector<IdField>& ids,
                                VtuCompression compression, const std::vector<NameList>& names) {
  SurfaceSnapshots(nodes, ids, compression, names).write(path, fields);
}

void write_vtm(const std::filesystem::path& path, const std::vector<VtmBlock>& blocks) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n  <vtkMultiBlockDataSet>\n";
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    text += "    <Block index=\"" + std::to_string(b) + "\" name=\"" + escaped(blocks[b].name) + "\">\n";
    for (std::size_t i = 0; i < blocks[b].files.size(); ++i)
      text += "      <DataSet index=\"" + std::to_string(i) + "\" file=\"" +
              escaped(blocks[b].files[i].generic_string()) + "\"/>\n";
    text += "    </Block>\n";
  }
  write_text_file(path, text + "  </vtkMultiBlockDataSet>\n</VTKFile>\n");
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
