#include "kinetics/series/course_figures.h"

#include <cmath>
#include <tuple>

namespace kinetics {

using Eigen::ArrayXd;
using Eigen::Index;

void CourseSums::add(const ArrayXd& values, const ArrayXd& time_s) {
  const Index n = values.size() - 2;
  for (Index i = 1; i <= n; ++i) {
    double value = values[i], time = time_s[i];
    const double before = values[i - 1] - value, after = values[i + 1] - value;
    if (before * after >= 0 && before + after != 0) {
      const double steps = (before - after) / (2 * (before + after));
      value += (after - before) / 4 * steps;
      time += steps * (time_s[1] - time_s[0]);
    }
    if (n_ == 0 || value > figures_.largest) figures_.largest = value, figures_.time_of_largest_s = time;
    if (n_ == 0 || value < figures_.least) figures_.least = value, figures_.time_of_least_s = time;
    ++n_;
  }
  sum_ += values.segment(1, n).sum();
  norm_ = std::hypot(norm_, values.segment(1, n).matrix().stableNorm());
}

CourseFigures CourseSums::figures() const {
  auto figures = figures_;
  figures.mean = sum_ / double(n_);
  figures.rms = norm_ / std::sqrt(double(n_));
  return figures;
}

std::vector<CourseFigures> course_figures(const LoadHistory& history) {
  const Index n = history.n_instants();
  const double step_s = history.time_s[1] - history.time_s[0];
  ArrayXd time_s(n + 2);
  time_s << history.time_s[0] - step_s, history.time_s, history.time_s[n - 1] + step_s;
  std::vector<CourseFigures> figures;
  const auto take = [&](const std::string& name, const ArrayXd& values) {
    ArrayXd around(n + 2);
    around << 2 * values[0] - values[1], values, 2 * values[n - 1] - values[n - 2];  // no crest at the ends
    CourseSums sums(name);
    sums.add(around, time_s);
    figures.push_back(sums.figures());
  };
  for (const auto& quantity : history.quantities)
    if (quantity.has_statistics) take(quantity.name, quantity.values);
  for (const auto& resultant : history.resultants)
    for (const auto& [row, component] : {std::tuple{0, ".fx"}, {1, ".fy"}, {2, ".torque"}})
      if ((resultant.total.row(row) != 0).any())
        take(resultant.role + component, resultant.total.row(row).transpose());
  return figures;
}

}  // namespace kinetics
