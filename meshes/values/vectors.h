/// Vectors of three numbers.
#pragma once

#include <array>
#include <cmath>

namespace meshes {

using Vector = std::array<double, 3>;

inline Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double length(const Vector& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace meshes
