/// A beam of hexahedra whose inner nodes lie anywhere but where they should.
#pragma once

#include <cmath>

#include "fem/base/values/body.h"
#include "tests/verification/fem/bodies/block_mesh.h"

namespace verification {

/// Inner nodes moved against each other; the sides of the unit cube stay.
inline Point distorted(const Point& c, double amount) {
  const auto bump = [](double t) { return t * (1 - t); };
  return c + 4 * amount *
                 Point(bump(c[0]) * std::sin(5 * c[1] + 3 * c[2]), bump(c[1]) * std::sin(4 * c[2] + 5 * c[0]),
                       bump(c[2]) * std::sin(3 * c[0] + 4 * c[1]));
}

/// w x h x l about the z axis, from z = 0.
inline fem::Body distorted_beam(const Point& size, const std::array<int, 3>& cells, double distortion,
                                const fem::Material& material, int degree) {
  Block block;
  block.cells = cells;
  block.map = [size, distortion](const Point& c) {
    const Point d = distorted(c, distortion);
    return Point(size[0] * (d[0] - 0.5), size[1] * (d[1] - 0.5), size[2] * d[2]);
  };
  fem::Body body;
  body.mesh = hexahedra_of(block);
  body.material = material;
  body.degree = degree;
  return body;
}

}  // namespace verification
