/// Smooth periodic interpolation that never leaves the range of its neighbours.
#pragma once

#include <Eigen/Core>

namespace kinetics::table {

/// The piecewise cubic of Fritsch and Carlson (1980) with Brodlie's weighted harmonic mean as slope, closed
/// over one period. Between two samples it stays between them; third order where the samples are smooth,
/// second at their extremes.
class PeriodicCubic {
public:
  /// @param at      strictly ascending, at least two; at.last < at.first + period
  /// @param period  > 0
  PeriodicCubic(Eigen::ArrayXd at, Eigen::ArrayXd values, double period);

  double operator()(double x) const;

private:
  Eigen::ArrayXd at_, values_, slopes_;  // the first sample repeated at the end, a period later
  double period_;
};

}  // namespace kinetics::table
