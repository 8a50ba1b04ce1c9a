/// An order of cells and nodes in which neighbours are near each other in memory, and its parts. Internal to
/// fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/mesh/grid.h"

namespace fem {

/// Cells in the order of repeated bisection of their centres across the longest extent; nodes in the order in
/// which these cells meet them; parts of the cells that different threads may work on. All depends on the
/// mesh alone.
struct CellOrder {
  std::vector<std::int32_t> cell;        ///< cell at each place
  std::vector<std::int32_t> node_place;  ///< place of each node
  std::vector<std::size_t> part_begin;   ///< parts are ranges of places; n_parts + 1
};
CellOrder order_cells(const Grid& grid);

/// The share that each cell falls to: shares are halved by their number across the longest extent, again and
/// again, and have cells as their weights.
std::vector<int> deal_out_cells(const Grid& grid, const std::vector<double>& weights);

/// Of shares that are all alike.
std::vector<double> even_weights(int n_shares);

/// Where the parts add to nodes, so that each part writes places of its own: the first part that meets a node
/// writes to it, others to copies of it; coded as elastic_kernel.h wants it.
struct AddTargets {
  std::vector<std::int32_t> node;    ///< nodes_per_cell per cell, cells in order: place of the node
  std::vector<std::int32_t> target;  ///< the same: where to add
  std::vector<std::int32_t> copied;  ///< places of the nodes that the copies belong to, ascending
  std::vector<std::int32_t> copy;    ///< and the copies
};
AddTargets make_targets(const Grid& grid, const CellOrder& order);

}  // namespace fem
