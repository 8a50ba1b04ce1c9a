/// Fields on a body as VTK XML files that ParaView opens: 27-node hexahedra or 10-node tetrahedra, or the
/// 9-node or 6-node faces of the surface. Points in m as 64-bit floats; data appended; no date, so the same
/// input gives the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

enum class FieldPrecision { float32, float64 };

/// Numbers at the nodes, looked at in place: `values` has to outlive the call it is given to.
struct NodalField {
  std::string name;  ///< with the unit: "von Mises stress [Pa]"
  int n_components = 1;
  const double* values = nullptr;  ///< n_nodes x n_components, the components of a node together
  std::size_t n_values = 0;        ///< n_nodes * n_components, checked
  std::vector<std::string> component_names = {};  ///< none, or one each
  FieldPrecision precision = FieldPrecision::float32;
};

/// A field over a vector of n_nodes x n_components values.
inline NodalField nodal_field(std::string name, const std::vector<double>& values, int n_components = 1,
                              std::vector<std::string> component_names = {}) {
  return {std::move(name), n_components, values.data(), values.size(), std::move(component_names)};
}

/// Ids: zones, boundaries, instants. At the nodes, or one per cell of the file (hexahedra, or faces of a
/// surface).
struct IdField {
  enum class At { nodes, cells };
  std::string name;
  std::vector<std::int32_t> values;
  At at = At::nodes;
};

/// Words for the ids of a field, kept beside the cells as field data.
struct NameList {
  std::string name;
  std::vector<std::string> names;
};

/// Numbers of the whole body, kept likewise.
struct NumberList {
  std::string name;
  std::vector<double> values;
};

struct FieldData {
  std::vector<NameList> names;
  std::vector<NumberList> numbers;
};

enum class VtuCompression {
  none,
  zlib,
  lzma  ///< two thirds of the bytes for seven times the seconds
};

/// The files have indices of 32 bits: numbers of nodes, and the place where each cell's list of nodes ends.
/// @throws FileError naming the file, what it would hold and the remedy if they do not suffice
void refuse_beyond_32_bits(const std::filesystem::path& path, std::size_t n_nodes, std::size_t n_cells,
                           std::size_t nodes_per_cell);

/// The first field is the one that viewers show first.
///
/// The whole body: VTK_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON or
/// VTK_QUADRATIC_TETRA, all nodes in their order. VTK takes the nodes of cubic cells as evenly spaced in the
/// cell's own coordinates, where they are Gauss-Lobatto points: exact at the nodes, a little off between
/// them.
/// @throws std::invalid_argument naming the field if its size does not fit the nodes or cells;
///         std::runtime_error naming the file if it cannot be written
void write_envelope_vtu(const std::filesystem::path& path, const fem::Nodes& nodes,
                        const std::vector<NodalField>& fields, const std::vector<IdField>& ids = {},
                        VtuCompression compression = VtuCompression::zlib, const FieldData& data = {});

/// Ids at the nodes of a file that write_envelope_vtu wrote, in the order of the nodes; empty: it has none of
/// that name.
/// @throws FileError if it is no such file
std::vector<std::int32_t> read_node_ids(const std::filesystem::path& vtu, const std::string& name);

/// The whole body in pieces, one file each beside the .pvtu that joins them: envelope.pvtu, envelope_0.vtu,
/// envelope_1.vtu ... Nodes between pieces are in each of them.
/// @param pvtu  path of the file that joins them
/// @param piece_of_cell  0 .. n_pieces - 1
/// @throws as write_envelope_vtu
void write_envelope_pieces(const std::filesystem::path& pvtu, const fem::Nodes& nodes,
                           const std::vector<int>& piece_of_cell, int n_pieces,
                           const std::vector<NodalField>& fields, const std::vector<IdField>& ids = {},
                           VtuCompression compression = VtuCompression::zlib, const FieldData& data = {});

/// Files of the surface alone, which differ in their fields: the faces of the cells over the nodes that lie
/// on a boundary face, in ascending order of their numbers; the cell field `boundary_id` is added.
class SurfaceSnapshots {
public:
  /// @param nodes  nodes of the body; they outlive this
  /// @param ids    as for write_envelope_vtu; at cells: one per boundary face
  explicit SurfaceSnapshots(const fem::Nodes& nodes, std::vector<IdField> ids = {},
                            VtuCompression compression = VtuCompression::zlib,
                            std::vector<NameList> names = {});

  /// Numbers of the nodes that the files hold.
  const std::vector<std::int32_t>& nodes() const noexcept { return chosen_; }

  /// Several threads may write files at a time.
  /// @param fields  at all nodes of the body; those inside are not looked at but for the largest value
  /// @throws as write_envelope_vtu
  void write(const std::filesystem::path& path, const std::vector<NodalField>& fields) const;

private:
  const fem::Nodes& nodes_;
  std::vector<IdField> ids_;
  VtuCompression compression_;
  std::vector<NameList> names_;
  std::vector<std::int32_t> chosen_, faces_;
};

/// One such file.
/// @throws as write_envelope_vtu
void write_surface_snapshot_vtu(const std::filesystem::path& path, const fem::Nodes& nodes,
                                const std::vector<NodalField>& fields, const std::vector<IdField>& ids = {},
                                VtuCompression compression = VtuCompression::zlib,
                                const std::vector<NameList>& names = {});

struct PvdEntry {
  double time_s = 0;
  std::filesystem::path file;  ///< relative to the directory of the .pvd
  std::string name;            ///< name of the part, for ParaView's block names; may be empty
};

/// A body among several, of one file or of pieces.
struct VtmBlock {
  std::string name;
  std::vector<std::filesystem::path> files;  ///< relative to the directory of the .vtm
};

/// Several bodies as one.
/// @throws FileError naming the file if it cannot be written
void write_vtm(const std::filesystem::path& path, const std::vector<VtmBlock>& blocks);

/// A collection of snapshots over time.
/// @throws FileError naming the file if it cannot be written
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace pipelines
