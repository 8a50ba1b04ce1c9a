/// Extremes, mean and RMS of a quantity over its whole course, its crests between the instants among them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"

namespace kinetics {

/// A quantity over the whole course between the instants.
struct CourseFigures {
  std::string quantity;  ///< as in compute_loads: "<element>.torque" ..., "<role>.fx"
  double largest = 0, least = 0, mean = 0, rms = 0;  ///< in its unit
  double time_of_largest_s = 0, time_of_least_s = 0;
};

/// Figures of a quantity from one block of instants after the other.
class CourseSums {
public:
  explicit CourseSums(std::string quantity = "") { figures_.quantity = std::move(quantity); }

  /// A crest is that of the parabola through the highest of three instants and its neighbours: by 24 of them
  /// in a period of the fastest harmonic it misses 0.01 % of that harmonic at most.
  /// @param values  the block's, and one before and one behind it
  /// @param time_s  times of the same instants, at equal steps
  void add(const Eigen::ArrayXd& values, const Eigen::ArrayXd& time_s);
  CourseFigures figures() const;

private:
  CourseFigures figures_;
  double sum_ = 0, norm_ = 0;
  Eigen::Index n_ = 0;
};

/// Figures of all quantities that have statistics, and of all components of resultants that are not zero
/// throughout.
/// @param history  at equal steps of time, two instants or more; crests at its ends are those of its instants
std::vector<CourseFigures> course_figures(const LoadHistory& history);

}  // namespace kinetics
