#include "fem/recovery/recovery_on_ranks.h"
#include "fem/mesh/cell_order.h"

#include <utility>

#include "fem/common/memory.h"
#include "fem/operators/subdomain.h"
#include "fem/ranks/node_exchange.h"
#include "fem/ranks/ranks.h"
#include "fem/recovery/stress_recovery.h"
#include "fem/recovery/stress_samples.h"
#include "fem/recovery/volumetric_stress.h"

namespace fem {

namespace {

// A node takes its share from corners of its cells (1 layer around a rank's nodes), or from those that stand
// in for them (2), whose patches (3; tetrahedra take up to two more) have to know their neighbours' place in
// the body (1 more).
constexpr int n_layers = 6;

/// Rank 0 has the responses of the whole body: it leaves the work to the others where they are several.
std::vector<double> weights_of_recovery(int n_ranks) {
  auto weights = even_weights(n_ranks);
  if (n_ranks > 2) weights.front() = 0;
  return weights;
}

/// What a rank is given.
struct RecoveryJob {
  Subdomain part;
  std::vector<Lame> elastic;
  std::vector<CylinderChart> charts;
  std::vector<int> loaded_groups;
  int by_patches = 1, hardly_compresses = 0;
  std::vector<std::int32_t> counted;  // nodes of the part that this rank counts

  template <typename Self>
  static auto members(Self& self) {
    return std::tie(self.part, self.elastic, self.charts, self.loaded_groups, self.by_patches,
                    self.hardly_compresses, self.counted);
  }
};

/// Called on all ranks.
/// @return of the nodes that this rank counts
RowMajor recover_share(MPI_Comm communicator, const RecoveryJob& job, const NodeExchange& all_nodes,
                       const ConstBlock& displacement) {
  const RowMajor own = all_nodes.from_first(displacement, 1);
  RowMajor counted(0, 2 * own.cols());
  agree(communicator, [&] {
    const auto& grid = job.part.grid;
    if (grid.n_cells() == 0) return;
    RowMajor result(grid.n_nodes, 2 * own.cols());
    const auto cells = cells_of_nodes(grid);
    const auto elastic = cell_after_cell(job.elastic);
    if (job.by_patches != 0)
      recover_stress(grid, cells, job.charts, free_faces(grid, job.loaded_groups), elastic,
                     job.hardly_compresses != 0, own, result);
    else
      average_stress(grid, cells, elastic, own, result);
    counted = result(job.counted, Eigen::all);
  });
  return counted;
}

}  // namespace

void recover_stress(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                    const std::vector<CylinderChart>& charts, const std::vector<int>& loaded_groups,
                    bool by_patches, const ConstBlock& displacement, Eigen::Ref<RowMajor> stress,
                    const NodeSelection& selection) {
  if (!by_patches) {
    average_stress(grid, cells, elastic, displacement, stress);
    return;
  }
  recover_stress(grid, cells, charts, free_faces(grid, loaded_groups), elastic,
                 any_hardly_compresses(grid, elastic), displacement, stress, selection);
}

void recover_stress_on_ranks(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                             const std::vector<CylinderChart>& charts, const std::vector<int>& loaded_groups,
                             bool by_patches, const ConstBlock& displacement, std::vector<double>& stress_Pa,
                             MPI_Comm communicator) {
  const int n = n_ranks(communicator);
  const auto rank_of_cell = deal_out_cells(grid, weights_of_recovery(n));
  const auto rank_of_node = ranks_of_nodes(grid, rank_of_cell);
  std::vector<std::vector<std::int32_t>> nodes(n), counted_nodes(n);
  RecoveryJob job;
  job.charts = charts;
  job.loaded_groups = loaded_groups;
  job.by_patches = by_patches ? 1 : 0;
  job.hardly_compresses = any_hardly_compresses(grid, elastic) ? 1 : 0;  // somewhere in the body
  for (int r = n - 1; r >= 0; --r) {
    job.part = make_subdomain(
        grid,
        with_cells_hung_on(grid, cells, with_layers(grid, cells, cells_of_rank(rank_of_cell, r), n_layers)));
    job.elastic = elastic_of(job.part, elastic);
    nodes[r] = job.part.node;
    job.counted.clear();
    for (std::size_t i = 0; i < job.part.node.size(); ++i)
      if (rank_of_node[job.part.node[i]] == r) {
        job.counted.push_back(static_cast<std::int32_t>(i));
        counted_nodes[r].push_back(job.part.node[i]);
      }
    if (r == 0) continue;
    Message message;
    message << job;
    message.send(r, communicator);
  }
  const RowMajor counted = recover_share(communicator, job, {communicator, nodes}, displacement);
  job = {};
  release_free_memory();  // of the patches: the whole body's stress needs it
  stress_Pa.assign(grid.n_nodes * std::size_t(counted.cols()), 0);
  Eigen::Map<RowMajor> stress(stress_Pa.data(), Eigen::Index(grid.n_nodes), counted.cols());
  NodeExchange(communicator, std::move(counted_nodes)).add_on_first(counted, 1, stress);
}

void help_to_recover_stress(MPI_Comm communicator) {
  RecoveryJob job;
  Message message = Message::receive(0, communicator);
  message >> job;
  message = {};
  RowMajor none(0, 0);
  const RowMajor counted = recover_share(communicator, job, {communicator, {}}, none);
  NodeExchange(communicator, {}).add_on_first(counted, 1, none);
}

}  // namespace fem
