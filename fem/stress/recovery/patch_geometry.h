/// Where patches lie: coordinates along their mesh lines, and the directions of the stress components that
/// are fitted. Internal to fem.
#pragma once

#include <vector>

#include "fem/base/values/body.h"
#include "fem/mesh/grid/grid.h"
#include "fem/stress/recovery/patch_fit.h"
#include "fem/stress/recovery/stress_samples.h"

namespace fem {

/// Positions of all samples (cell after cell) and nodes, in space and, where cells have a cylinder chart, in
/// the chart.
class PatchGeometry {
public:
  PatchGeometry(const Grid& grid, const CellsOfNodes& cells, const StressSamples& samples,
                const std::vector<CylinderChart>& charts);

  /// Whether all cells around the corner have charts. Such patches are fitted in (r, theta, z), with stress
  /// components along r, theta, z: bodies of revolution have a few sectors around, and a quarter of a turn is
  /// no straight line.
  bool is_round(std::int32_t corner) const;

  /// Samples in the cells around the corner and on their free faces; with more layers, also in the cells that
  /// touch those, and so on.
  std::vector<std::int32_t> samples_around(std::int32_t corner, int n_layers = 1) const;

  PatchPoints points(std::int32_t corner, const std::vector<std::int32_t>& samples,
                     const std::vector<std::int32_t>& nodes) const;

  double sample_angle(std::int32_t sample) const { return chart_samples_(1, sample); }
  double node_angle(std::int32_t node) const { return chart_nodes_(1, node); }

private:
  Eigen::Matrix3d directions(std::int32_t corner, bool round) const;
  Eigen::Vector3d offset(const Eigen::Vector3d& position, std::int32_t corner, bool round) const;

  const Grid& grid_;
  const CellsOfNodes& cells_;
  const StressSamples& samples_;
  Points chart_samples_, chart_nodes_;
  std::vector<char> has_chart_;  // cells
};

/// Components xx, yy, zz, xy, yz, xz in axes turned by the angle about z (cosine, sine); in place.
void turn_about_z(double cosine, double sine, double* tensor);

}  // namespace fem
