/// Numbers rounded to fewer bits, so that files of them compress.
#pragma once

#include <cmath>

namespace pipelines {

/// Rounds to the nearest number with so many significant bits, by Dekker's splitting; the range stays that of
/// a double.
/// @param bits  2 to 52; a double has 53
inline double with_significant_bits(double value, int bits) {
  const double scaled = (std::ldexp(1, 53 - bits) + 1) * value, rounded = scaled - (scaled - value);
  return std::isfinite(rounded) ? rounded : value;
}

}  // namespace pipelines
