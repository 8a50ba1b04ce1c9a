/// One-dimensional distributions of cell boundaries. Lengths in m, or fractions where said so.
#pragma once

#include <vector>

namespace meshes {

/// Boundaries of n cells on [0, 1] in geometric progression.
/// @param first size of the first cell as a fraction of the length; cells only ever grow: where n cells of
///              that size would not fit, the cells are equal
/// @return n + 1 ascending numbers, exactly 0 and 1 at the ends
std::vector<double> geometric_fractions(int n, double first);

/// Smallest number of cells that covers `length_m` when the first is `first_m` long and each is at most
/// `ratio` times the one before it. At least 1.
int geometric_count(double length_m, double first_m, double ratio);

/// Wanted cell size along the axis: min(largest, size_i + growth |z - z_i|) over the sources.
struct AxialSize {
  struct Source {
    double z_m = 0, size_m = 0;
  };
  std::vector<Source> sources;
  double largest_m = 0;
  double growth = 0;

  double at(double z_m) const;
};

/// Cell boundaries from begin to end that follow the wanted size: its reciprocal is integrated and inverted.
/// @param n_min smallest number of cells
/// @param subdivisions  parts that each of them is cut into
/// @return ascending, exactly begin and end at the ends
std::vector<double> axial_stations(double begin_m, double end_m, const AxialSize& size, int n_min,
                                   int subdivisions = 1);

/// Cuts each interval between ascending (or descending) values into n, whose sizes pass smoothly from one
/// interval to the next: the values are kept, a geometric progression nearly stays one, and cuts into 2 are
/// among those into 4. By rational quadratic splines (Gregory and Delbourgo 1982: monotone), whose slope at a
/// value is the geometric mean of the intervals beside it.
std::vector<double> subdivided(const std::vector<double>& values, int n);

}  // namespace meshes
