#include "fem/operators/material_interfaces.h"

#include <algorithm>
#include <map>
#include <utility>

#include "fem/mesh/cell_geometry.h"

namespace fem {

namespace {

/// Materials at each node, ascending; only nodes with several are listed.
std::map<std::int32_t, std::vector<int>> shared_nodes(const Grid& grid, const CellsOfNodes& cells,
                                                      const CellMaterials& materials) {
  std::map<std::int32_t, std::vector<int>> shared;
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    std::vector<int> kinds;
    for (auto k = cells.begin[i]; k < cells.begin[i + 1]; ++k)
      kinds.push_back(materials.kind(std::size_t(cells.cell[k])));
    std::sort(kinds.begin(), kinds.end());
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    if (kinds.size() > 1) shared.emplace(static_cast<std::int32_t>(i), std::move(kinds));
  }
  return shared;
}

/// Whether a cell of another material holds all corners of the face.
bool meets_another_material(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials,
                            std::size_t cell, const std::vector<std::int32_t>& corners) {
  const auto first = std::size_t(corners[0]);
  for (auto k = cells.begin[first]; k < cells.begin[first + 1]; ++k) {
    const auto other = std::size_t(cells.cell[k]);
    if (materials.kind(other) == materials.kind(cell)) continue;
    const auto *begin = grid.nodes_of(other), *end = begin + grid.nodes_per_cell();
    if (std::all_of(corners.begin(), corners.end(),
                    [&](auto node) { return std::find(begin, end, node) != end; }))
      return true;
  }
  return false;
}

std::vector<BoundaryFace> faces_between(const Grid& grid, const CellsOfNodes& cells,
                                        const CellMaterials& materials,
                                        const std::map<std::int32_t, std::vector<int>>& shared) {
  std::vector<BoundaryFace> faces;
  const auto places = face_corners(grid.shape());
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < grid.shape().n_faces(); ++f) {
      const auto nodes = nodes_of_face(grid, c, f);
      std::vector<std::int32_t> corners;
      for (const int place : places) corners.push_back(nodes[place]);
      if (std::all_of(corners.begin(), corners.end(), [&](auto node) { return shared.count(node) > 0; }) &&
          meets_another_material(grid, cells, materials, c, corners))
        faces.push_back({static_cast<std::int32_t>(c), f, 0});
    }
  return faces;
}

}  // namespace

SplitGrid split_at_interfaces(const Grid& grid, const CellsOfNodes& cells, const CellMaterials& materials) {
  SplitGrid split{grid, {}};
  const auto shared = shared_nodes(grid, cells, materials);
  std::map<std::pair<std::int32_t, int>, std::int32_t> further;  // of a node and a material but its first
  for (const auto& [node, kinds] : shared)
    for (std::size_t k = 1; k < kinds.size(); ++k) {
      further[{node, kinds[k]}] = static_cast<std::int32_t>(split.grid.n_nodes++);
      split.copy.push_back(node);
      for (int d = 0; d < 3; ++d) split.grid.xyz_m.push_back(grid.position(node)[d]);
    }
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < grid.nodes_per_cell(); ++i) {
      auto& node = split.grid.cell_nodes[c * grid.nodes_per_cell() + i];
      if (const auto found = further.find({node, materials.kind(c)}); found != further.end())
        node = found->second;
    }
  split.grid.interfaces = faces_between(grid, cells, materials, shared);
  return split;
}

Grid grid_of_stress(const Grid& grid, const CellMaterials& materials) {
  return materials.is_uniform() ? grid : split_at_interfaces(grid, cells_of_nodes(grid), materials).grid;
}

}  // namespace fem
