#include "fem/stress/recovery/stress_samples.h"

#include <algorithm>

#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

std::vector<BoundaryFace> free_faces(const Grid& grid, const std::vector<int>& loaded_groups) {
  std::vector<BoundaryFace> free;
  for (const auto& face : grid.boundary)
    if (std::find(loaded_groups.begin(), loaded_groups.end(), face.boundary_id) == loaded_groups.end())
      free.push_back(face);
  return free;
}

StressSamples make_samples(const Grid& grid, const std::vector<BoundaryFace>& free) {
  const Tabulation inside = stress_points_in_cell(grid.shape()),
                   on_face = stress_points_on_face(grid.shape());
  const auto n_inside = static_cast<Eigen::Index>(grid.n_cells()) * inside.n_points;
  StressSamples samples;
  samples.position.resize(3, n_inside + static_cast<Eigen::Index>(free.size()) * on_face.n_points);
  samples.of_cell.resize(grid.n_cells());
  const auto add = [&](std::int32_t cell, const Eigen::Vector3d& x) {
    const auto sample = static_cast<std::int32_t>(samples.cell.size());
    samples.position.col(sample) = x;
    samples.of_cell[cell].push_back(sample);
    samples.cell.push_back(cell);
  };
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int q = 0; q < inside.n_points; ++q) add(static_cast<std::int32_t>(c), position(grid, c, inside, q));
  for (const auto& face : free) {
    const auto nodes = nodes_of_face(grid, face.cell, face.face);
    for (int q = 0; q < on_face.n_points; ++q) add(face.cell, face_point(grid, nodes, on_face, q).position);
  }
  return samples;
}

RowMajor stress_at_samples(const Grid& grid, const std::vector<BoundaryFace>& free,
                           const PerCell<Lame>& elastic, const ConstBlock& displacement) {
  const Tabulation inside = stress_points_in_cell(grid.shape()),
                   on_face = stress_points_on_face(grid.shape());
  const auto n_inside = static_cast<Eigen::Index>(grid.n_cells()) * inside.n_points;
  RowMajor stress(n_inside + static_cast<Eigen::Index>(free.size()) * on_face.n_points,
                  2 * displacement.cols());
  parallel_for(grid.n_cells(), 32, [&](std::size_t begin, std::size_t end) {
    CellStress compute(grid, inside, elastic, displacement);
    for (std::size_t c = begin; c < end; ++c)
      compute(c, stress.middleRows(c * inside.n_points, inside.n_points));
  });
  parallel_for(free.size(), 32, [&](std::size_t begin, std::size_t end) {
    FreeFaceStress compute(grid, on_face, elastic, displacement);
    for (std::size_t f = begin; f < end; ++f)
      compute(free[f], stress.middleRows(n_inside + f * on_face.n_points, on_face.n_points));
  });
  return stress;
}

}  // namespace fem
