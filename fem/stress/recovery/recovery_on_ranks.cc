#include "fem/stress/recovery/recovery_on_ranks.h"

#include <utility>

#include "fem/base/common/memory.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/ranks/row_exchange.h"
#include "fem/stress/recovery/volumetric_stress.h"

namespace fem {

namespace {

// A node takes its share from corners of its cells (1 layer around a rank's nodes), or from those that stand
// in for them (2), whose patches (3; tetrahedra take up to two more) have to know their neighbours' place in
// the body (1 more).
constexpr int n_layers = 6;

/// Hanging nodes have the stress that their masters fix, wherever these are.
void set_own_hanging_rows(const HangingNodes& hanging, const SharedRows& shared, RowMajor& stress) {
  std::vector<std::int32_t> masters;
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < hanging.n(); ++i) {
    if (shared.row[std::size_t(hanging.node[i])] < 0) continue;
    own.push_back(i);
    masters.insert(masters.end(), hanging.master.begin() + std::ptrdiff_t(hanging.begin[i]),
                   hanging.master.begin() + std::ptrdiff_t(hanging.begin[i + 1]));
  }
  const RowMajor of_masters = RowExchange(shared, std::move(masters))(stress);
  Eigen::Index at = 0;
  for (const auto i : own) {
    auto row = stress.row(shared.row[std::size_t(hanging.node[i])]);
    row.setZero();
    for (auto k = hanging.begin[i]; k < hanging.begin[i + 1]; ++k)
      row += hanging.weight[k] * of_masters.row(at++);
  }
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

RecoveryCase recovery_case(const Grid& grid, const PerCell<Lame>& elastic,
                           const std::vector<int>& loaded_groups) {
  return {[loaded_groups](const Subdomain& part) { return free_faces(part.grid, loaded_groups); },
          any_hardly_compresses(grid, elastic)};
}

RowMajor recover_stress_on_ranks(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                                 const std::vector<CylinderChart>& charts, const RecoveryCase* by_patches,
                                 const SharedRows& shared, const ConstBlock& displacement) {
  const auto own_cells = cells_of_rank(shared.rank_of_cell, this_rank(shared.communicator));
  const Subdomain part =
      make_subdomain(grid, with_cells_hung_on(grid, cells, with_layers(grid, cells, own_cells, n_layers)));
  RowMajor of_part(Eigen::Index(part.grid.n_nodes), 2 * displacement.cols());
  {
    const RowMajor around = RowExchange(shared, part.node)(displacement);
    agree(shared.communicator, [&] {
      if (part.grid.n_cells() == 0) return;
      const auto cells_of_part = cells_of_nodes(part.grid);
      const auto elastic_of_part = cell_after_cell(elastic_of(part, elastic));
      if (by_patches != nullptr)
        recover_stress(part.grid, cells_of_part, charts, by_patches->free_faces(part), elastic_of_part,
                       by_patches->hardly_compresses, around, of_part);
      else
        average_stress(part.grid, cells_of_part, elastic_of_part, around, of_part);
    });
  }
  RowMajor stress(Eigen::Index(shared.node.size()), of_part.cols());
  for (std::size_t i = 0; i < part.node.size(); ++i)
    if (const auto row = shared.row[std::size_t(part.node[i])]; row >= 0)
      stress.row(row) = of_part.row(Eigen::Index(i));
  of_part.resize(0, 0);
  release_free_memory();  // of the patches
  if (grid.hanging.n() > 0) set_own_hanging_rows(grid.hanging, shared, stress);
  return stress;
}

}  // namespace fem
