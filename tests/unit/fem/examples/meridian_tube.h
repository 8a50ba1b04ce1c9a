/// Half sections of tubes and bars.
#pragma once

#include "tests/unit/fem/examples/shaft_bodies.h"

namespace fem_tests {

enum TubeSurface { left = 1, right = 2, outside = 3, inside = 4 };

/// A tube or bar a < r < b, 0 < z < L of n_z by n_r cells.
inline fem::MeridianBody tube(double a, double b, double L, int n_z, int n_r) {
  fem::MeridianBody body;
  body.material = steel;
  body.n_angles = 12;
  for (int i = 0; i <= n_z; ++i)
    for (int k = 0; k <= n_r; ++k) body.points_m.push_back({L * i / n_z, a + (b - a) * k / n_r});
  const auto at = [=](int i, int k) { return i * (n_r + 1) + k; };
  for (int i = 0; i < n_z; ++i) {
    for (int k = 0; k < n_r; ++k)
      body.cells.push_back({{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)}});
    body.edges.push_back({{at(i + 1, n_r), at(i, n_r)}, outside});
    if (a > 0) body.edges.push_back({{at(i, 0), at(i + 1, 0)}, inside});
  }
  for (int k = 0; k < n_r; ++k) {
    body.edges.push_back({{at(0, k + 1), at(0, k)}, left});
    body.edges.push_back({{at(n_z, k), at(n_z, k + 1)}, right});
  }
  return body;
}

inline fem::LoadSurface face(int id, double z) {
  return {fem::LoadSurface::Kind::face, id, {0, 0, z}};
}

}  // namespace fem_tests
