#include "fem/mesh/grid/hanging_nodes.h"

#include <algorithm>

namespace fem {

namespace {

/// Calls handle(node, master, weight) for every pair.
template <typename Handle>
void for_each_master(const HangingNodes& hanging, const Handle& handle) {
  for (std::size_t i = 0; i < hanging.n(); ++i)
    for (auto k = hanging.begin[i]; k < hanging.begin[i + 1]; ++k)
      handle(hanging.node[i], hanging.master[k], hanging.weight[k]);
}

}  // namespace

void set_hanging_unknowns(const HangingNodes& hanging, Eigen::Ref<Eigen::MatrixXd> values) {
  for (const auto node : hanging.node) values.middleRows<3>(3 * Eigen::Index(node)).setZero();
  for_each_master(hanging, [&](std::int32_t node, std::int32_t master, double weight) {
    values.middleRows<3>(3 * Eigen::Index(node)) += weight * values.middleRows<3>(3 * Eigen::Index(master));
  });
}

void set_hanging_rows(const HangingNodes& hanging, Eigen::Ref<NodeRows> values) {
  for (const auto node : hanging.node) values.row(node).setZero();
  for_each_master(hanging, [&](std::int32_t node, std::int32_t master, double weight) {
    values.row(node) += weight * values.row(master);
  });
}

void move_to_masters(const HangingNodes& hanging, Eigen::Ref<Eigen::MatrixXd> forces) {
  for_each_master(hanging, [&](std::int32_t node, std::int32_t master, double weight) {
    forces.middleRows<3>(3 * Eigen::Index(master)) += weight * forces.middleRows<3>(3 * Eigen::Index(node));
  });
  for (const auto node : hanging.node) forces.middleRows<3>(3 * Eigen::Index(node)).setZero();
}

CellCouplings::CellCouplings(const Grid& grid) : grid_(grid), of_cell_(grid.n_cells(), -1) {
  const auto& hanging = grid.hanging;
  if (hanging.n() == 0) return;
  std::vector<std::int32_t> place(grid.n_nodes, -1);  // among the hanging nodes
  for (std::size_t i = 0; i < hanging.n(); ++i) place[std::size_t(hanging.node[i])] = std::int32_t(i);
  const int n_local = grid.nodes_per_cell();
  for (std::size_t c = 0; c < grid.n_cells(); ++c) {
    const auto* own = grid.nodes_of(c);
    if (std::none_of(own, own + n_local, [&](auto node) { return place[node] >= 0; })) continue;
    Coupling coupling;
    for (int i = 0; i < n_local; ++i) {
      const auto hangs = place[own[i]];
      if (hangs < 0)
        coupling.node.push_back(own[i]);
      else
        coupling.node.insert(coupling.node.end(), hanging.master.begin() + hanging.begin[hangs],
                             hanging.master.begin() + hanging.begin[hangs + 1]);
    }
    std::sort(coupling.node.begin(), coupling.node.end());
    coupling.node.erase(std::unique(coupling.node.begin(), coupling.node.end()), coupling.node.end());
    const auto column = [&](std::int32_t node) {
      return std::lower_bound(coupling.node.begin(), coupling.node.end(), node) - coupling.node.begin();
    };
    coupling.weight.setZero(n_local, Eigen::Index(coupling.node.size()));
    for (int i = 0; i < n_local; ++i) {
      const auto hangs = place[own[i]];
      if (hangs < 0)
        coupling.weight(i, column(own[i])) = 1;
      else
        for (auto k = hanging.begin[hangs]; k < hanging.begin[hangs + 1]; ++k)
          coupling.weight(i, column(hanging.master[k])) = hanging.weight[k];
    }
    of_cell_[c] = std::int32_t(couplings_.size());
    couplings_.push_back(std::move(coupling));
  }
}

void CellCouplings::couple(std::size_t cell, int n, Eigen::MatrixXd& rows) const {
  if (of_cell_[cell] < 0) return;
  const auto& weight = special(cell).weight;
  Eigen::MatrixXd coupled = Eigen::MatrixXd::Zero(n * weight.cols(), rows.cols());
  for (Eigen::Index m = 0; m < weight.cols(); ++m)
    for (Eigen::Index i = 0; i < weight.rows(); ++i)
      if (weight(i, m) != 0) coupled.middleRows(n * m, n) += weight(i, m) * rows.middleRows(n * i, n);
  rows.swap(coupled);
}

}  // namespace fem
