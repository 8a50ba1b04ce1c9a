/// Five coordinates of a stress, by whose 2-norm von Mises is given.
#pragma once

#include <cmath>

namespace pipelines {

/// sqrt(3)/2 (xx - yy), (xx + yy - 2 zz) / 2, sqrt(3) xy, sqrt(3) yz, sqrt(3) xz.
/// @param stress       xx, yy, zz, xy, yz, xz
/// @param coordinates  five, to be written; may be `stress` itself
inline void find_deviatoric_coordinates(const double* stress, double* coordinates) {
  const double root = std::sqrt(3.0), xx = stress[0], yy = stress[1], zz = stress[2];
  coordinates[0] = root / 2 * (xx - yy);
  coordinates[1] = (xx + yy - 2 * zz) / 2;
  for (int c = 2; c < 5; ++c) coordinates[c] = root * stress[c + 1];
}

}  // namespace pipelines
