#include "fem/stress/recovery/stress_recovery.h"

#include <algorithm>

#include "fem/stress/recovery/volumetric_stress.h"

namespace fem {

void recover_stress(const Grid& grid, const CellsOfNodes& cells, const std::vector<CylinderChart>& charts,
                    const std::vector<BoundaryFace>& free, const PerCell<Lame>& elastic,
                    bool hardly_compresses, const ConstBlock& displacement, Eigen::Ref<RowMajor> stress,
                    const NodeSelection& selection) {
  const auto samples = make_samples(grid, free);
  RowMajor values = stress_at_samples(grid, free, elastic, displacement);
  if (!hardly_compresses)
    return recover_by_patches(grid, cells, charts, samples, values, stress, {}, selection);
  const auto volumetric = separate_volumetric(grid, elastic, displacement, samples, values);
  recover_by_patches(grid, cells, charts, samples, values, stress, {grid.degree, true}, selection);
  RowMajor part(stress.rows(), stress.cols());
  recover_by_patches(grid, cells, charts, volumetric.samples, volumetric.values, part,
                     {std::max(grid.degree - 1, 1), true}, selection);
  stress += part;
}

}  // namespace fem
