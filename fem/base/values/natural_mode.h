/// Natural vibrations of a body. Plain values, no deal.II.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/unit_load.h"

namespace fem {

/// One undamped free vibration of a body at rest.
struct NaturalMode {
  double frequency_Hz = 0;
  /// n_nodes x 3, nodes as in body_nodes() and UnitResponses::nodes; of modal mass 1, so in kg^(-1/2). The
  /// largest entry is positive. A repeated frequency's shapes are any orthogonal ones of theirs.
  std::vector<double> shape;
  double residual = 0;  ///< |K x - w^2 M x| / |w^2 M x|
  /// Share of the frequency by which the mesh may have it too high, estimated: three times the energy that
  /// the cells' stress misses by the recovered one.
  double error = 0;
};

/// A rigid mass that moves with a surface of the body without being meshed.
struct AttachedMass {
  LoadSurface surface;
  double mass_kg = 0;
  std::array<double, 3> offset_m{};       ///< of its centre from the surface's
  std::array<double, 3> inertia_kg_m2{};  ///< about axes along x, y, z through its own centre
};

}  // namespace fem
