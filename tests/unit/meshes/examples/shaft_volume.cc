#include "tests/unit/meshes/examples/shaft_volume.h"
#include "meshes/values/constants.h"

#include <cmath>

namespace {

using meshes::pi;

/// Adds up cylinders(radius, length) and fillets(small radius, fillet).
template <typename Cylinder, typename Fillet>
double sum_of_parts(const meshes::Shaft& shaft, Cylinder cylinder, Fillet fillet) {
  double volume = 0;
  const auto& segments = shaft.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const double radius_m = 0.5 * segments[i].diameter_m;
    double length_m = segments[i].end_m - segments[i].begin_m;
    const auto take_fillet = [&](const meshes::ShaftSegment& neighbour, double fillet_m) {
      if (neighbour.diameter_m <= segments[i].diameter_m || fillet_m == 0) return;
      length_m -= fillet_m;
      volume += fillet(radius_m, fillet_m);
    };
    if (i > 0) take_fillet(segments[i - 1], shaft.fillets_m[i - 1]);
    if (i + 1 < segments.size()) take_fillet(segments[i + 1], shaft.fillets_m[i]);
    volume += cylinder(radius_m, length_m) -
              cylinder(0.5 * segments[i].bore_m, segments[i].end_m - segments[i].begin_m);
  }
  return volume;
}

}  // namespace

double polygon_area(double radius_m, int n_corners) {
  return 0.5 * n_corners * std::sin(2 * pi / n_corners) * radius_m * radius_m;
}

double polygonal_volume(const meshes::Shaft& shaft, int cells_per_fillet_quarter, int n_sectors) {
  const auto cylinder = [&](double radius_m, double length_m) {
    return polygon_area(radius_m, n_sectors) * length_m;
  };
  const auto fillet = [&](double radius_m, double fillet_m) {
    double volume = 0;
    double z = 0, r = radius_m;
    for (int i = 1; i <= cells_per_fillet_quarter; ++i) {
      const double angle = 0.5 * pi * i / cells_per_fillet_quarter;
      const double next_z = fillet_m * std::sin(angle), next_r = radius_m + fillet_m * (1 - std::cos(angle));
      const double mean_square = (r * r + r * next_r + next_r * next_r) / 3;
      volume += polygon_area(1, n_sectors) * mean_square * (next_z - z);
      z = next_z;
      r = next_r;
    }
    return volume;
  };
  return sum_of_parts(shaft, cylinder, fillet);
}

double true_volume(const meshes::Shaft& shaft) {
  const auto cylinder = [](double radius_m, double length_m) { return pi * radius_m * radius_m * length_m; };
  const auto fillet = [](double radius_m, double f) {
    const double centre_m = radius_m + f;
    return pi * f * (centre_m * centre_m - centre_m * f * pi / 2 + 2 * f * f / 3);
  };
  return sum_of_parts(shaft, cylinder, fillet);
}
