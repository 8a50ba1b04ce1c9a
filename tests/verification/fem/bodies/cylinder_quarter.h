/// A quarter of a hollow cylinder between the symmetry planes x = 0 and y = 0, curved by its chart.
#pragma once

#include <cmath>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace verification {

struct QuarterSizes {
  double inner_radius_m = 0, outer_radius_m = 0, height_m = 0;
  int n_radial = 1, n_around = 1, n_along = 1;
};

/// Sides: radius (1), angle from +x (2), z from 0 (3). Radii in geometric progression, as stress falls. Held:
/// u_y at y = 0, u_x at x = 0, u_z at z = 0.
inline fem::Body cylinder_quarter(const QuarterSizes& sizes) {
  Block block;
  block.cells = {sizes.n_radial, sizes.n_around, sizes.n_along};
  block.map = [sizes](const Point& c) {
    const double r = sizes.inner_radius_m * std::pow(sizes.outer_radius_m / sizes.inner_radius_m, c[0]);
    // cos(pi/2) is not 0 to the last bit; that is far below the tolerance of a symmetry plane.
    return Point(r * std::cos(pi / 2 * c[1]), r * std::sin(pi / 2 * c[1]), sizes.height_m * c[2]);
  };
  fem::Body body;
  body.mesh = hexahedra_of(block);
  fem::CylinderChart chart;
  chart.volume_id = block_volume;
  body.cylinders = {chart};
  body.clamps = {
      {begin_2, {false, true, false}}, {end_2, {true, false, false}}, {begin_3, {false, false, true}}};
  return body;
}

}  // namespace verification
