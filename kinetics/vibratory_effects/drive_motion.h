/// A drive whose speed is linear between the entries of a table, segment by segment, with its steps.
#pragma once

#include <vector>

#include "kinetics/vibratory_effects/drive_course.h"
#include "kinetics/vibratory_effects/motion.h"

namespace kinetics::vibratory {

/// One straight piece of the speed.
struct DriveSegment {
  double start_s = 0, duration_s = 0;
  double phi_rad = 0, speed_rad_s = 0;  ///< at its start
  double acceleration_rad_s2 = 0;
  Eigen::Index n_steps = 0;  ///< equal steps, a multiple of RunUp::steps_per_instant

  double step_s() const { return duration_s / double(n_steps); }
  /// Ends of all steps, n_steps + 1.
  Eigen::ArrayXd times_s() const {
    return Eigen::ArrayXd::LinSpaced(n_steps + 1, start_s, start_s + duration_s);
  }
};

/// The table's segments with steps no longer than step_s.
std::vector<DriveSegment> drive_segments(const VibratoryMill& mill, const RunUp& run, double step_s);

/// Instants at the ends of steps first .. first + count - 1, without pitch.
Instants segment_instants(const VibratoryMill& mill, const DriveSegment& segment, Eigen::Index first,
                          Eigen::Index count);

}  // namespace kinetics::vibratory
