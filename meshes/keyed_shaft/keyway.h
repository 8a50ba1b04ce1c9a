/// A keyway of a shaft.
#pragma once

#include <string>

namespace meshes {

/// A slot milled into the surface of a segment: a flat floor, walls parallel to the plane through the
/// segment's axis and the slot's middle line.
struct Keyway {
  std::string segment;
  double width_m = 0;
  double depth_m = 0;       ///< from the surface at the middle line to the floor
  double length_m = 0;      ///< over all, round ends included
  double begin_m = 0;       ///< z of the end with the smaller z
  double angle_rad = 0;     ///< angle of the middle line about the segment's axis, from +x
  bool round_ends = false;  ///< half circles of the width (end mill); else square
};

}  // namespace meshes
