#include "fem/solvers/iterative_on_ranks.h"

#include <algorithm>
#include <utility>

#include "fem/common/memory.h"
#include "fem/mesh/cell_order.h"
#include "fem/operators/shared_nodes.h"
#include "fem/ranks/ranks.h"
#include "fem/solvers/iterative_solve.h"

namespace fem {

namespace {

/// Moves the nodes that this rank counts to the front; their order stays.
void count_first(const std::vector<char>& counted, std::vector<std::int32_t>& node_place) {
  std::vector<std::int32_t> node_at(node_place.size());
  for (std::size_t i = 0; i < node_place.size(); ++i) node_at[node_place[i]] = static_cast<std::int32_t>(i);
  std::stable_partition(node_at.begin(), node_at.end(), [&](auto node) { return counted[node] != 0; });
  for (std::size_t place = 0; place < node_at.size(); ++place)
    node_place[node_at[place]] = static_cast<std::int32_t>(place);
}

SharedNodes share_nodes(MPI_Comm communicator, const RankPart& part, std::vector<Neighbour> neighbours,
                        const CellOrder& order) {
  const auto& own = part.share.part.node;
  for (auto& neighbour : neighbours)
    for (auto& node : neighbour.nodes) node = order.node_place[node];
  std::vector<std::int32_t> body_node(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) body_node[order.node_place[i]] = own[i];
  return {communicator, std::move(neighbours), part.n_counted(), std::move(body_node)};
}

}  // namespace

std::vector<double> weights_of_iteration(int n_ranks) {
  auto weights = even_weights(n_ranks);
  if (n_ranks > 2) weights.back() = 0.2;
  return weights;
}

std::optional<Solution> solve_iteratively_on_ranks(const Grid& grid, const CellsOfNodes& cells,
                                                   const CellMaterials& materials, const RankPart& part,
                                                   const BalancedLoads& loads, const SolverChoice& choice,
                                                   const StepReport& progress, std::string& failure,
                                                   MPI_Comm communicator) {
  progress(0.05, "prepare multigrid");
  const auto& own = part.share.part.grid;
  CellOrder order = order_cells(own);
  count_first(part.counted, order.node_place);
  const SharedNodes shared =
      share_nodes(communicator, part, neighbours_of(part, grid, cells, n_ranks(communicator)), order);
  auto solution = iterate(own, order, cell_after_cell(part.share.elastic), materials.largest_modulus_Pa(),
                          loads, static_cast<Eigen::Index>(loads_per_block(3 * grid.n_nodes)), choice,
                          progress, failure, &shared);
  if (!solution) return std::nullopt;
  release_free_memory();  // of operator and multigrid
  solution->ranks = gather_work(communicator, {part.share.n_own_cells(), part.n_unknowns, solution->bytes});
  solution->bytes = 0;
  for (const auto& work : solution->ranks) solution->bytes += work.bytes;
  return solution;
}

}  // namespace fem
