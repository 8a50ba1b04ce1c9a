/// The section of a body of revolution as the harmonics compute with it: nodes of curved quadrilaterals,
/// shape functions at quadrature points, plain arrays. Internal to fem.
///
/// The cells of MeridianBody may be cut; a node in the middle of a larger neighbour's edge has no unknowns of
/// its own, and the shape functions here are those of the nodes that it hangs on.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "fem/models/axisymmetric/meridian_body.h"

namespace fem {

/// Shape functions of one cell at one of its points.
struct SectionPoint {
  int cell = 0;
  double z_m = 0, r_m = 0;
  double weight = 0;  ///< area of the section, or length of the edge, that the point stands for
  double normal_z = 0, normal_r = 0;  ///< outwards; edges only
  Eigen::ArrayXd value, by_z, by_r;   ///< one entry per node of the cell
};

/// Edge of the surface with its quadrature points, and the result points at its begin, middle and end (the
/// material on the left).
struct SurfaceEdge {
  int boundary_id = 0;
  std::vector<SectionPoint> points;
  std::array<int, 3> result_points{};
};

/// A point at which the result is wanted; its stress is the mean over the samples.
struct ResultPoint {
  double z_m = 0, r_m = 0;            ///< r is 0 on the axis
  std::vector<SectionPoint> samples;  ///< one per cell that has the point
  bool on_axis() const { return r_m == 0; }
};

/// A cell as the result shows it: at the surface one that is cut no more, inside one of those beside these. A
/// polygon through its corners, the middles of its surface edges and the corners of smaller neighbours. With
/// a centre it is a fan of triangles around that, without one a quadrilateral.
struct ResultPolygon {
  std::vector<int> points;  ///< counter-clockwise in (z, r)
  int centre = -1;
  double volume_m3 = 0;  ///< of the ring
};

/// The straight line of cell edges that a section plane is, seen from the cells on both of its sides.
struct PlaneLine {
  std::vector<SectionPoint> points;  ///< weights: lengths; on both sides half of them
};

struct MeridianGrid {
  std::vector<double> z_m, r_m;  ///< by node
  std::vector<std::vector<int>> cell_nodes;
  std::vector<std::vector<SectionPoint>> cell_points;
  std::vector<SurfaceEdge> edges;
  std::vector<ResultPoint> results;
  std::vector<ResultPolygon> polygons;
  std::vector<PlaneLine> planes;
  std::vector<char> on_axis;  ///< by node

  int n_nodes() const noexcept { return int(z_m.size()); }
};

/// @throws std::invalid_argument if cells are inverted, an edge belongs to no cell, the degree is not 1 to 4,
/// or a plane is no line of cell edges from the bore or the axis to the surface
MeridianGrid meridian_grid(const MeridianBody& body, const std::vector<SectionPlane>& planes = {});

}  // namespace fem
