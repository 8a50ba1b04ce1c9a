/// The section of a body of revolution as the harmonics compute with it: nodes of curved quadrilaterals,
/// shape functions at quadrature points, plain arrays. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/meridian_body.h"

namespace fem {

/// Shape functions of one cell at one of its points.
struct SectionPoint {
  int cell = 0;
  double z_m = 0, r_m = 0;
  double weight = 0;  ///< area of the section, or length of the edge, that the point stands for
  double normal_z = 0, normal_r = 0;  ///< outwards; edges only
  Eigen::ArrayXd value, by_z, by_r;   ///< one entry per node of the cell
};

/// Edge of the surface with its quadrature points, and the surface points at its begin, middle and end (the
/// material on the left).
struct SurfaceEdge {
  int boundary_id = 0;
  std::vector<SectionPoint> points;
  std::array<int, 3> surface_points{};
};

/// A point of the surface; its stress is the mean over the samples.
struct SurfacePoint {
  double z_m = 0, r_m = 0;
  std::vector<SectionPoint> samples;  ///< one per cell that has the point
};

struct MeridianGrid {
  std::vector<double> z_m, r_m;  ///< by node
  std::vector<std::vector<int>> cell_nodes;
  std::vector<std::vector<SectionPoint>> cell_points;
  std::vector<SurfaceEdge> edges;
  std::vector<SurfacePoint> surface;
  std::vector<char> on_axis;  ///< by node

  int n_nodes() const noexcept { return int(z_m.size()); }
};

/// @throws std::invalid_argument if cells are inverted, an edge belongs to no cell, or the degree is not 1 to
/// 4
MeridianGrid meridian_grid(const MeridianBody& body);

}  // namespace fem
