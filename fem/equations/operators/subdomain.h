/// The parts of a body that the ranks work on. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <vector>

#include "fem/base/values/per_cell.h"
#include "fem/base/values/unit_responses.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// Some cells of a body as a mesh of their own. Nodes and cells keep their order, so that what is computed on
/// them takes the same steps as on the whole body.
struct Subdomain {
  Grid grid;
  std::vector<std::int32_t> node;  ///< number in the body of each node, ascending
  std::vector<std::int32_t> cell;  ///< likewise of each cell
};
/// @param cells  ascending
/// @throws std::logic_error if a node hangs on one that is left out
Subdomain make_subdomain(const Grid& grid, const std::vector<std::int32_t>& cells);
/// The same of a solution's cells, without their faces.
Subdomain make_subdomain(const Nodes& nodes, const std::vector<std::int32_t>& cells);
/// All of them; nodes that no cell has are left out.
Subdomain make_subdomain(const Nodes& nodes);

/// The rank that counts each node: the first of those of its cells.
std::vector<int> ranks_of_nodes(const Grid& grid, const std::vector<int>& rank_of_cell);

/// Each rank has the rows of the nodes that it counts.
std::shared_ptr<SharedRows> share_rows(MPI_Comm communicator, const Grid& grid,
                                       const std::vector<int>& rank_of_cell);

/// Unknowns at the nodes that a rank counts; hanging nodes have none.
std::size_t n_unknowns_of_rank(const Grid& grid, const std::vector<int>& rank_of_node, int rank);

/// Numbers of the nodes of some cells, ascending.
std::vector<std::int32_t> nodes_of_cells(const Grid& grid, const std::vector<std::int32_t>& cells);

/// Cells of a rank, ascending.
std::vector<std::int32_t> cells_of_rank(const std::vector<int>& rank_of_cell, int rank);

/// Those cells, and so many layers of cells that touch them. Ascending.
std::vector<std::int32_t> with_layers(const Grid& grid, const CellsOfNodes& cells_of_nodes,
                                      const std::vector<std::int32_t>& cells, int n_layers);

/// Those cells, and of a mesh that is refined locally the larger ones that their nodes hang on, and what the
/// nodes of these hang on in turn. Ascending.
std::vector<std::int32_t> with_cells_hung_on(const Grid& grid, const CellsOfNodes& cells_of_nodes,
                                             const std::vector<std::int32_t>& cells);

/// The share of one rank in a body's stiffness: its cells, and those that their nodes hang on, which are
/// there without stiffness of their own.
struct StiffnessShare {
  Subdomain part;
  std::vector<Lame> elastic;  ///< of the part's cells; zero where another rank has the cell
  std::size_t n_own_cells() const;
};
StiffnessShare share_of_rank(const Grid& grid, const CellsOfNodes& cells_of_nodes,
                             const std::vector<int>& rank_of_cell, int rank, const PerCell<Lame>& elastic);

/// What a rank has of a body. All ranks have the mesh, and deal its cells out alike.
struct RankPart {
  /// @param cells_of_first  of rank 0, to one of each other rank's (deal_out_cells)
  RankPart(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic, int rank, int n_ranks,
           double cells_of_first = 1);

  int rank;
  std::vector<int> rank_of_cell, rank_of_node;
  StiffnessShare share;
  std::vector<char> counted;   ///< of the share's nodes: those that this rank counts
  std::size_t n_unknowns = 0;  ///< at those nodes

  /// Rows of the share's nodes, `n_rows` each, of those of the whole body.
  template <typename Whole>
  typename Whole::PlainObject rows_of(const Whole& whole, int n_rows) const {
    const auto& node = share.part.node;
    typename Whole::PlainObject part(n_rows * Eigen::Index(node.size()), whole.cols());
    for (std::size_t i = 0; i < node.size(); ++i)
      part.middleRows(n_rows * Eigen::Index(i), n_rows) =
          whole.middleRows(n_rows * Eigen::Index(node[i]), n_rows);
    return part;
  }
};

/// Lame's constants of a subdomain's cells, one after another.
std::vector<Lame> elastic_of(const Subdomain& subdomain, const PerCell<Lame>& elastic);
PerCell<Lame> cell_after_cell(std::vector<Lame> elastic);

}  // namespace fem
