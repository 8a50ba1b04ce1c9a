/// Rows of a body's stiffness on the MPI rank that has them. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Rows of a body over the ranks: nodes that do not hang, rank after rank, ascending within each.
struct RowPlan {
  /// @param rank_of_node  the rank that has each node
  RowPlan(const Grid& grid, std::vector<int> rank_of_node, int rank, int n_ranks);

  bool is_own(std::int32_t row) const { return row >= first && row < first + std::int32_t(own.size()); }

  int rank, n_ranks;
  std::vector<int> rank_of_node;
  std::vector<std::int32_t> own;  ///< this rank's nodes, ascending
  std::vector<std::int32_t> row;  ///< of each of the body's nodes over all ranks; -1: it hangs
  std::int32_t first = 0;         ///< row of the first of its nodes
};

/// Compressed rows, columns ascending in each.
struct CompressedRows {
  std::vector<std::int32_t> begin{0}, column;
  std::vector<double> value;
};

/// The complete rows of this rank, three for each of its nodes: it assembles all cells that they depend on,
/// so that no rank waits for another one.
/// @param held  unknowns of the body whose rows and columns keep their diagonal only
/// @throws DoesNotFit if there are more entries than 32 bits count
CompressedRows stiffness_rows(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                              const RowPlan& plan, const std::vector<std::int64_t>& held);

}  // namespace fem
