#include "meshes/spacing/grading.h"

#include <algorithm>
#include <cmath>

namespace meshes {

namespace {

/// 1 + q + ... + q^(n-1)
double geometric_sum(int n, double q) {
  double sum = 0, term = 1;
  for (int i = 0; i < n; ++i, term *= q) sum += term;
  return sum;
}

}  // namespace

std::vector<double> geometric_fractions(int n, double first) {
  double ratio = 1;
  if (n > 1 && n * first < 1) {
    double low = 1, high = 2;
    while (first * geometric_sum(n, high) < 1) high *= 2;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (first * geometric_sum(n, middle) < 1 ? low : high) = middle;
    }
    ratio = low;
  }
  const double total = geometric_sum(n, ratio);
  std::vector<double> fractions(n + 1);
  for (int i = 1; i < n; ++i) fractions[i] = geometric_sum(i, ratio) / total;
  fractions[n] = 1;
  return fractions;
}

int geometric_count(double length_m, double first_m, double ratio) {
  int n = 1;
  for (double cell_m = first_m, covered_m = first_m; covered_m < length_m * (1 - 1e-9); ++n) {
    cell_m *= ratio;
    covered_m += cell_m;
  }
  return n;
}

double AxialSize::at(double z_m) const {
  double size_m = largest_m;
  for (const Source& source : sources)
    size_m = std::min(size_m, source.size_m + growth * std::abs(z_m - source.z_m));
  return size_m;
}

std::vector<double> axial_stations(double begin_m, double end_m, const AxialSize& size, int n_min,
                                   int subdivisions) {
  const int n_samples = 4000;
  const double step_m = (end_m - begin_m) / n_samples;
  std::vector<double> cells(n_samples + 1);  // number of cells from begin up to each sample
  for (int i = 0; i < n_samples; ++i)
    cells[i + 1] = cells[i] + step_m / size.at(begin_m + (i + 0.5) * step_m);

  const double wanted = cells.back();
  const int n = subdivisions * std::max(n_min, static_cast<int>(std::ceil(wanted - 0.5)));
  std::vector<double> stations(n + 1);
  stations.front() = begin_m;
  stations.back() = end_m;
  for (int i = 1; i < n; ++i) {
    const double target = wanted * i / n;
    const auto above = std::upper_bound(cells.begin(), cells.end(), target);
    const auto sample = static_cast<double>(above - cells.begin() - 1);
    const double below = *(above - 1);
    stations[i] = begin_m + step_m * (sample + (target - below) / (*above - below));
  }
  return stations;
}

std::vector<double> subdivided(const std::vector<double>& values, int n) {
  if (n == 1 || values.size() < 2) return values;
  const std::size_t n_steps = values.size() - 1;
  std::vector<double> steps(n_steps), slopes(n_steps + 1);
  for (std::size_t i = 0; i < n_steps; ++i) steps[i] = values[i + 1] - values[i];
  for (std::size_t i = 1; i < n_steps; ++i)
    slopes[i] = std::copysign(std::sqrt(steps[i - 1] * steps[i]), steps[i]);
  slopes.front() = n_steps > 1 ? steps.front() * steps.front() / slopes[1] : steps.front();
  slopes.back() = n_steps > 1 ? steps.back() * steps.back() / slopes[n_steps - 1] : steps.back();

  std::vector<double> result = {values.front()};
  for (std::size_t i = 0; i < n_steps; ++i) {
    for (int k = 1; k < n; ++k) {
      const double t = double(k) / n, both = t * (1 - t);
      const double share = (steps[i] * t * t + slopes[i] * both) /
                           (steps[i] + (slopes[i] + slopes[i + 1] - 2 * steps[i]) * both);
      result.push_back(values[i] + steps[i] * share);
    }
    result.push_back(values[i + 1]);
  }
  return result;
}

}  // namespace meshes
