/// What hanging nodes mean for vectors and for cells. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/mesh/grid/grid.h"

namespace fem {

using NodeRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Gives every hanging node the value that its masters fix.
/// @param values  unknowns (3 per node) x columns
void set_hanging_unknowns(const HangingNodes& hanging, Eigen::Ref<Eigen::MatrixXd> values);

/// The same of values in rows.
/// @param values  nodes x columns
void set_hanging_rows(const HangingNodes& hanging, Eigen::Ref<NodeRows> values);

/// Forces at hanging nodes go to their masters, with the same virtual work; none are left at the nodes.
/// @param forces  unknowns (3 per node) x columns
void move_to_masters(const HangingNodes& hanging, Eigen::Ref<Eigen::MatrixXd> forces);

/// The nodes whose unknowns the displacement of a cell depends on: its own, masters in the place of hanging
/// ones.
class CellCouplings {
public:
  explicit CellCouplings(const Grid& grid);

  /// Whether none of the cell's nodes hangs.
  bool is_plain(std::size_t cell) const { return of_cell_[cell] < 0; }
  int n_nodes(std::size_t cell) const {
    return of_cell_[cell] < 0 ? grid_.nodes_per_cell() : int(special(cell).node.size());
  }
  const std::int32_t* nodes(std::size_t cell) const {
    return of_cell_[cell] < 0 ? grid_.nodes_of(cell) : special(cell).node.data();
  }

  /// Takes what belongs to the cell's own nodes to the nodes that it depends on.
  /// @param rows  n rows for each of the cell's nodes; of them for each of nodes(cell) afterwards
  void couple(std::size_t cell, int n, Eigen::MatrixXd& rows) const;

private:
  struct Coupling {
    std::vector<std::int32_t> node;
    Eigen::MatrixXd weight;  ///< nodes of the cell x `node`
  };
  const Coupling& special(std::size_t cell) const { return couplings_[std::size_t(of_cell_[cell])]; }

  const Grid& grid_;
  std::vector<std::int32_t> of_cell_;  // -1: no node of the cell hangs
  std::vector<Coupling> couplings_;
};

/// For each node the cells whose displacement depends on it (CellCouplings), ascending.
CellsOfNodes cells_that_couple(const Grid& grid, const CellCouplings& couplings);

}  // namespace fem
