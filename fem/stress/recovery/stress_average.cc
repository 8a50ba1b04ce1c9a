#include "fem/base/common/parallel.h"
#include "fem/stress/recovery/stress_recovery.h"

namespace fem {

void average_stress(const Grid& grid, const CellsOfNodes& cells, const PerCell<Lame>& elastic,
                    const ConstBlock& displacement, Eigen::Ref<RowMajor> stress) {
  const Tabulation at = nodes_in_cell(grid.shape());
  stress.setZero();
  for (const auto& group : colour_cells(grid, cells))
    parallel_for(group.size(), 16, [&](std::size_t begin, std::size_t end) {
      CellStress compute(grid, at, elastic, displacement);
      RowMajor local(at.n_points, stress.cols());
      for (std::size_t c = begin; c < end; ++c) {
        compute(group[c], local);
        for (int i = 0; i < at.n_points; ++i) stress.row(grid.nodes_of(group[c])[i]) += local.row(i);
      }
    });
  for (std::size_t i = 0; i < grid.n_nodes; ++i) stress.row(i) /= double(cells.begin[i + 1] - cells.begin[i]);
}

}  // namespace fem
