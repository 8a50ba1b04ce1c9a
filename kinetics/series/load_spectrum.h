/// From a load over time to counted cycles: rainflow, spectrum.
///
/// Source: ASTM E1049-85 (2017), 5.4.4 rainflow counting and 5.4.5 its form for repeating histories. The unit
/// of ranges and means is that of the series.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetics {

/// What rainflow counts: a range (peak minus valley, > 0), its mean, and how often: 0.5 or 1 when counted.
struct LoadCycle {
  double range = 0;
  double mean = 0;
  double count = 0;
};

/// Half and full cycles of a series that does not repeat, E1049 5.4.4: a range that holds the starting point,
/// or that is left at the end, counts half. In the order in which they are counted; none for a constant
/// series.
/// @throws MachineRefused if the series is empty, or holds NaN or infinity (naming its index)
std::vector<LoadCycle> rainflow(const Eigen::ArrayXd& series);

/// Full cycles of one period of a series that repeats, E1049 5.4.5: counted from one largest value to the
/// next. It does not matter where the period was cut, nor whether its first value is repeated at its end.
/// @throws MachineRefused as rainflow
std::vector<LoadCycle> rainflow_repeating(const Eigen::ArrayXd& period);

/// Where a counted cycle lies in its series.
struct CycleEnds {
  Eigen::Index from = 0, to = 0;  ///< indices of its two turning points, from < to
};

/// The cycles of rainflow_repeating by their places. Cycles of one size are closed by neighbours, whatever
/// rounding does to them: what differs by no more than `alike` counts as equal, and smaller ranges are none.
/// @param alike  >= 0, in the unit of the series
/// @throws MachineRefused as rainflow, or if alike is negative or not finite
std::vector<CycleEnds> rainflow_repeating_ends(const Eigen::ArrayXd& period, double alike);

/// Exact spectrum: equal (range, mean) merged, their counts summed; by falling range, then rising mean.
std::vector<LoadCycle> spectrum(std::vector<LoadCycle> cycles);

}  // namespace kinetics
