/// How far curved faces of a mesh are from the surfaces that they stand for.
#pragma once

#include <array>
#include <cstddef>
#include <map>

namespace fem {

/// Distance of curved faces from the cylinders and tori that they stand for.
struct GeometryError {
  /// Largest on one surface, relative.
  struct OnSurface {
    double of_axis = 0;    ///< distance over the distance from the axis of the cylinder or torus
    double of_fillet = 0;  ///< distance over the radius of the fillet; 0: a cylinder
  };
  std::map<int, OnSurface> surfaces;  ///< by boundary id
  std::size_t n_faces = 0;            ///< that were compared
  double relative = 0;                ///< largest, in radii of its surface
  double error_m = 0;                 ///< there
  std::array<double, 3> place_m{};    ///< there
};

}  // namespace fem
