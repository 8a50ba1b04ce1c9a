/// A shaft as a beam: cylinders end to end, and the pieces of its surface on which stress is told. Plain
/// values, no deal.II. Lengths in m; z along the shaft.
#pragma once

#include <cstddef>
#include <vector>

#include "fem/base/values/body.h"

namespace fem {

/// A cylinder about (axis_x, axis_y) with a bore about the z axis.
struct BeamSegment {
  double begin_m = 0, end_m = 0;
  double radius_m = 0;
  double bore_radius_m = 0;  ///< 0: solid
  double axis_x_m = 0, axis_y_m = 0;
};

/// A fillet between segments `junction` and `junction` + 1, on the surface of the thinner one.
struct BeamFillet {
  std::size_t junction = 0;
  double radius_m = 0;
  int boundary_id = 0;
};

/// Part of a segment's outer surface.
struct BeamPiece {
  std::size_t segment = 0;
  double begin_m = 0, end_m = 0;
  int boundary_id = 0;
};

struct BeamShaft {
  std::vector<BeamSegment> segments;  ///< ascending in z, without gaps
  std::vector<BeamFillet> fillets;
  std::vector<BeamPiece> pieces;
  Material material;
  int n_angles = 32;  ///< nodes on a circle, even, the first one at +x from the segment's axis
};

}  // namespace fem
