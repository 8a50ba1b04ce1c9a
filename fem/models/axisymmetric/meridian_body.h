/// A body of revolution about the z axis, as values: half its lengthwise section, meshed. No deal.II. Lengths
/// in m; boundary ids are those of the solid's mesh.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fem/base/values/body.h"

namespace fem {

struct MeridianCell {
  std::array<int, 4> corners{};  ///< counter-clockwise in (z, r)
};

/// A cell's edge on the surface; the axis has none.
struct MeridianEdge {
  std::array<int, 2> ends{};  ///< the material on its left in (z, r)
  int boundary_id = 0;
};

/// A cylinder of the true body that is concentric in the section.
struct EccentricCylinder {
  double begin_m = 0, end_m = 0, radius_m = 0;
  double axis_x_m = 0, axis_y_m = 0;
};

/// Cells near a circle of the body are cut in four until none is longer than `size_m` and
/// MeridianBody::fine_growth times its distance from the circle.
struct FineCircle {
  double z_m = 0, r_m = 0;
  double size_m = 0;
};

struct MeridianBody {
  std::vector<std::array<double, 2>> points_m;  ///< z, r
  std::vector<MeridianCell> cells;
  std::vector<MeridianEdge> edges;
  std::vector<TorusChart> tori;  ///< circles that edges are arcs of
  std::vector<EccentricCylinder> eccentric;
  Material material;
  int degree = 3;     ///< of displacement and geometry, 1 to 4
  int n_angles = 48;  ///< nodes around in the result, even, the first one at +x
  int n_cuts = 0;     ///< of all cells, each in four, after those near the fine circles
  std::vector<FineCircle> fine_circles{};
  double fine_growth = 0.5;
  /// Masses of the body as its loads know it, where that is not this section: the resultants of body forces
  /// become those of these masses, by a rigid field of accelerations that balancing takes away again.
  std::optional<MassProperties> masses_of_loads{};
};

}  // namespace fem
