#include "fem/solvers/iterative_on_ranks.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fem/common/memory.h"
#include "fem/mesh/cell_order.h"
#include "fem/operators/shared_nodes.h"
#include "fem/operators/subdomain.h"
#include "fem/ranks/node_exchange.h"
#include "fem/ranks/ranks.h"
#include "fem/solvers/iterative_solve.h"

namespace fem {

namespace {

/// The last rank has the trilinear level besides: on four ranks that takes the memory of some 15 % of the
/// cells.
std::vector<double> weights_of_iteration(int n_ranks) {
  auto weights = even_weights(n_ranks);
  if (n_ranks > 2) weights.back() = 0.5;
  return weights;
}

/// What a rank is given.
struct IterativeJob {
  StiffnessShare share;
  std::vector<char> counted;  // nodes that this rank counts
  std::vector<Neighbour> neighbours;
  double modulus_Pa = 1;
  std::size_t n_unknowns = 0;  // of the nodes that this rank counts
  Eigen::Index width = 0;
  SolverChoice choice;
  Eigen::RowVectorXd norm, largest_entry;  // of the loads

  template <typename Self>
  static auto members(Self& self) {
    return std::tie(self.share, self.counted, self.neighbours, self.modulus_Pa, self.n_unknowns, self.width,
                    self.choice, self.norm, self.largest_entry);
  }
};

/// Moves the nodes that this rank counts to the front; their order stays.
void count_first(const std::vector<char>& counted, std::vector<std::int32_t>& node_place) {
  std::vector<std::int32_t> node_at(node_place.size());
  for (std::size_t i = 0; i < node_place.size(); ++i) node_at[node_place[i]] = static_cast<std::int32_t>(i);
  std::stable_partition(node_at.begin(), node_at.end(), [&](auto node) { return counted[node] != 0; });
  for (std::size_t place = 0; place < node_at.size(); ++place)
    node_place[node_at[place]] = static_cast<std::int32_t>(place);
}

SharedNodes share_nodes(MPI_Comm communicator, const IterativeJob& job, const CellOrder& order) {
  auto neighbours = job.neighbours;
  for (auto& neighbour : neighbours)
    for (auto& node : neighbour.nodes) node = order.node_place[node];
  std::vector<std::int32_t> body_node(job.share.part.node.size());
  for (std::size_t i = 0; i < body_node.size(); ++i) body_node[order.node_place[i]] = job.share.part.node[i];
  const auto n_counted = std::count(job.counted.begin(), job.counted.end(), 1);
  return {communicator, std::move(neighbours), static_cast<std::size_t>(n_counted), std::move(body_node)};
}

/// Rows of the nodes that this rank counts.
Eigen::MatrixXd counted_rows(const IterativeJob& job, const Eigen::MatrixXd& all) {
  Eigen::MatrixXd counted(3 * std::count(job.counted.begin(), job.counted.end(), 1), all.cols());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < job.counted.size(); ++i)
    if (job.counted[i] != 0) {
      counted.middleRows<3>(row) = all.middleRows<3>(3 * Eigen::Index(i));
      row += 3;
    }
  return counted;
}

/// Called on all ranks.
/// @param force  on rank 0: of the body; kept there only if the iteration fails
/// @return displacements of the nodes that this rank counts; their reports are those of the body
std::optional<Solution> iterate_share(MPI_Comm communicator, const IterativeJob& job,
                                      const NodeExchange& all_nodes, const NodeExchange& counted_nodes,
                                      Eigen::MatrixXd& force, const StepReport& progress,
                                      std::string& failure) {
  CellOrder order = order_cells(job.share.part.grid);
  count_first(job.counted, order.node_place);
  const SharedNodes shared = share_nodes(communicator, job, order);
  BalancedLoads loads;
  const auto n_rows = force.rows();
  loads.force = all_nodes.from_first(force, 3);
  force.resize(0, 0);
  loads.norm = job.norm;
  loads.largest_entry = job.largest_entry;
  const auto collect = [&](const Eigen::MatrixXd& own, Eigen::MatrixXd& whole) {
    const auto counted = counted_rows(job, own);
    whole = Eigen::MatrixXd::Zero(n_rows, n_rows > 0 ? own.cols() : 0);
    counted_nodes.add_on_first(counted, 3, whole);
  };
  std::optional<Solution> solution;
  try {
    solution = iterate(job.share.part.grid, order, cell_after_cell(job.share.elastic), job.modulus_Pa, loads,
                       job.width, job.choice, progress, failure, &shared);
  } catch (const FailedTogether&) {
    collect(loads.force, force);
    throw;
  }
  if (!solution) {
    collect(loads.force, force);
    return std::nullopt;
  }
  loads.force.resize(0, 0);
  release_free_memory();  // of operator and multigrid
  solution->ranks = gather_work(communicator, {job.share.n_own_cells(), job.n_unknowns, solution->bytes});
  const Eigen::MatrixXd own = std::move(solution->displacement);
  collect(own, solution->displacement);
  return solution;
}

}  // namespace

std::optional<Solution> solve_iteratively_on_ranks(const Grid& grid, const CellsOfNodes& cells,
                                                   const CellMaterials& materials, BalancedLoads& loads,
                                                   const SolverChoice& choice, const StepReport& progress,
                                                   std::string& failure, MPI_Comm communicator) {
  progress(0.05, "prepare multigrid");
  const int n = n_ranks(communicator);
  const auto rank_of_cell = deal_out_cells(grid, weights_of_iteration(n));
  const auto rank_of_node = ranks_of_nodes(grid, rank_of_cell);
  std::vector<std::vector<std::int32_t>> nodes, counted_nodes(n);
  for (int r = 0; r < n; ++r)
    nodes.push_back(nodes_of_cells(grid, with_cells_hung_on(grid, cells, cells_of_rank(rank_of_cell, r))));
  auto neighbours = find_neighbours(nodes, grid.n_nodes);
  IterativeJob job;
  job.modulus_Pa = materials.largest_modulus_Pa();
  const auto elastic = materials.elastic(job.modulus_Pa);
  job.width = static_cast<Eigen::Index>(loads_per_block(3 * grid.n_nodes));
  job.choice = choice;
  job.norm = loads.norm;
  job.largest_entry = loads.largest_entry;
  for (int r = n - 1; r >= 0; --r) {
    job.share = share_of_rank(grid, cells, rank_of_cell, r, elastic);
    job.neighbours = std::move(neighbours[r]);
    job.n_unknowns = n_unknowns_of_rank(grid, rank_of_node, r);
    job.counted.clear();
    for (const auto node : job.share.part.node) {
      job.counted.push_back(rank_of_node[node] == r ? 1 : 0);
      if (rank_of_node[node] == r) counted_nodes[r].push_back(node);
    }
    if (r == 0) continue;
    {
      Message message;
      message << job;
      message.send(r, communicator);
    }
    release_free_memory();
  }
  auto solution = iterate_share(communicator, job, {communicator, nodes}, {communicator, counted_nodes},
                                loads.force, progress, failure);
  if (solution) {
    solution->bytes = 0;
    for (const auto& work : solution->ranks) solution->bytes += work.bytes;
  }
  return solution;
}

void help_to_solve_iteratively(MPI_Comm communicator) {
  IterativeJob job;
  Message message = Message::receive(0, communicator);
  message >> job;
  message = {};
  std::string failure;
  Eigen::MatrixXd none;
  iterate_share(
      communicator, job, {communicator, {}}, {communicator, {}}, none, [](double, const auto&) {}, failure);
}

}  // namespace fem
