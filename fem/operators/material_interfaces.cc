#include "fem/operators/material_interfaces.h"

#include <algorithm>
#include <map>
#include <utility>

#include "fem/mesh/connected_pieces.h"

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

std::vector<BoundaryFace> faces_between(const Grid& grid, const CellMaterials& materials) {
  std::vector<BoundaryFace> faces;
  const auto beyond = cells_beyond_faces(grid);
  const int n_faces = grid.shape().n_faces();
  for (std::size_t k = 0; k < beyond.size(); ++k) {
    const auto cell = k / std::size_t(n_faces);
    if (beyond[k] >= 0 && materials.kind(std::size_t(beyond[k])) != materials.kind(cell))
      faces.push_back({static_cast<std::int32_t>(cell), static_cast<int>(k % std::size_t(n_faces)), 0});
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
  split.grid.interfaces = faces_between(grid, materials);
  return split;
}

Grid grid_of_stress(const Grid& grid, const CellMaterials& materials) {
  return materials.is_uniform() ? grid : split_at_interfaces(grid, cells_of_nodes(grid), materials).grid;
}

}  // namespace fem
