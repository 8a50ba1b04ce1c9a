/// Samples of several turns of the drive.
#pragma once

#include <Eigen/Core>

namespace pipelines {

/// Turns of the drive from the first sample to the last one.
double turns_between_ends(const Eigen::ArrayXd& angle_rad);

/// Whole turns that samples cover: the step from the last one to the first of the next turn may be missing.
/// @param angle_rad  angle of the drive, strictly ascending, at least two values
int whole_turns(const Eigen::ArrayXd& angle_rad);

struct MeanTurn {
  Eigen::ArrayXd angle_rad;  ///< angles of the samples of the first turn
  Eigen::ArrayXd values;     ///< mean over the turns
  double scatter = 0;        ///< largest difference of a turn from the mean
};

/// The mean of a load over whole turns at the angles of the first one. Between samples the cubic of the load
/// stage (kinetics/table/periodic_cubic.h): exact where each turn has its samples at the same angles. What
/// lies behind the last whole turn is left out.
/// @param n_turns  >= 1, at most whole_turns
MeanTurn mean_turn(const Eigen::ArrayXd& angle_rad, const Eigen::ArrayXd& values, int n_turns);

/// The same turn again and again, as entries of an array.
Eigen::ArrayXd repeated_angles(const Eigen::ArrayXd& angle_rad, int n_turns);

}  // namespace pipelines
