#include "meshes/spacing/disc.h"

#include <algorithm>
#include <cmath>

#include "meshes/values/constants.h"

namespace meshes {

namespace {

// Chosen for the largest smallest angle of the cells at 8 to 32 sectors.
const double corner_radius = 0.68;  // distance of a rounded square's corner, as a share of the radius
const double roundness = 0.45;      // 0: straight sides, 1: a circle

using Point2 = std::array<double, 2>;

/// Unit vector at node j of the circle; nodes on the axes exactly there.
Point2 direction(int j, int n_sectors) {
  const int quarter = n_sectors / 4;
  const int turns = j / quarter % 4;
  const double angle = 2 * pi * (j % quarter) / n_sectors;
  const double c = std::cos(angle), s = std::sin(angle);
  switch (turns) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

Point2 mix(const Point2& a, const Point2& b, double t) {
  return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t};
}

/// Node j on the rim of the rounded square.
Point2 square_rim(int j, int n_sectors) {
  const int quarter = n_sectors / 4;
  const Point2 corner = direction(j - j % quarter, n_sectors);
  const Point2 next = direction(j - j % quarter + quarter, n_sectors);
  const Point2 on_side = mix(corner, next, static_cast<double>(j % quarter) / quarter);
  const Point2 rim = mix(on_side, direction(j, n_sectors), roundness);
  return {corner_radius * rim[0], corner_radius * rim[1]};
}

/// Inside of the square: transfinite interpolation of its rim. Corner (0, 0) is rim node 0, (k, 0) rim node
/// k.
Point2 square_inside(int a, int b, int k, int n_sectors) {
  const double u = static_cast<double>(a) / k, v = static_cast<double>(b) / k;
  const auto rim = [&](int j) { return square_rim(j % n_sectors, n_sectors); };
  const Point2 bottom = rim(a), right = rim(k + b), top = rim(3 * k - a), left = rim(4 * k - b);
  const Point2 p00 = rim(0), p10 = rim(k), p11 = rim(2 * k), p01 = rim(3 * k);
  Point2 p{};
  for (int i = 0; i < 2; ++i)
    p[i] = (1 - v) * bottom[i] + v * top[i] + (1 - u) * left[i] + u * right[i] -
           ((1 - u) * (1 - v) * p00[i] + u * (1 - v) * p10[i] + u * v * p11[i] + (1 - u) * v * p01[i]);
  return p;
}

}  // namespace

Disc build_disc(int n_sectors, int subdivisions) {
  const int k = n_sectors / 4;
  const int n_rings = subdivisions * std::max(1, k / subdivisions / 3);
  Disc disc;
  disc.n_sectors = n_sectors;
  for (int ring = 0; ring <= n_rings; ++ring)
    for (int j = 0; j < n_sectors; ++j)
      disc.points.push_back(
          mix(direction(j, n_sectors), square_rim(j, n_sectors), static_cast<double>(ring) / n_rings));
  for (int ring = 0; ring < n_rings; ++ring)
    for (int j = 0; j < n_sectors; ++j) {
      const int next = (j + 1) % n_sectors;
      const int outer = ring * n_sectors, inner = outer + n_sectors;
      disc.quads.push_back({inner + j, outer + j, outer + next, inner + next});
    }

  const int rim = n_rings * n_sectors;
  std::vector<std::vector<int>> square(k + 1, std::vector<int>(k + 1));
  for (int b = 0; b <= k; ++b)
    for (int a = 0; a <= k; ++a) {
      if (b == 0)
        square[a][b] = rim + a;
      else if (a == k)
        square[a][b] = rim + k + b;
      else if (b == k)
        square[a][b] = rim + 3 * k - a;
      else if (a == 0)
        square[a][b] = rim + 4 * k - b;
      else {
        square[a][b] = static_cast<int>(disc.points.size());
        disc.points.push_back(square_inside(a, b, k, n_sectors));
      }
    }
  for (int b = 0; b < k; ++b)
    for (int a = 0; a < k; ++a)
      disc.quads.push_back({square[a][b], square[a + 1][b], square[a + 1][b + 1], square[a][b + 1]});
  return disc;
}

}  // namespace meshes
