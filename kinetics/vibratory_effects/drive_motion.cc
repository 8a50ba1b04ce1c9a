#include "kinetics/vibratory_effects/drive_motion.h"

#include <algorithm>
#include <cmath>

#include "kinetics/values/wrong_input.h"

namespace kinetics::vibratory {

std::vector<DriveSegment> drive_segments(const VibratoryMill& mill, const RunUp& run, double step_s) {
  constexpr double most_steps = 2e6;
  std::vector<DriveSegment> segments;
  double phi_rad = mill.initial_angle_rad, all_steps = 0;
  for (std::size_t i = 1; i < run.time_s.size(); ++i) {
    DriveSegment segment;
    segment.start_s = run.time_s[i - 1];
    segment.duration_s = run.time_s[i] - run.time_s[i - 1];
    segment.phi_rad = phi_rad;
    segment.speed_rad_s = run.speed_rad_s[i - 1];
    segment.acceleration_rad_s2 = (run.speed_rad_s[i] - run.speed_rad_s[i - 1]) / segment.duration_s;
    const double instants = std::ceil(segment.duration_s / step_s / run.steps_per_instant);
    all_steps += instants * run.steps_per_instant;
    if (all_steps > most_steps)
      refuse("run.step_s", step_s, "gives more than 2 million steps; shorten the run, or take longer steps");
    segment.n_steps = std::max<Eigen::Index>(1, Eigen::Index(instants)) * run.steps_per_instant;
    phi_rad += segment.duration_s * (run.speed_rad_s[i - 1] + run.speed_rad_s[i]) / 2;
    segments.push_back(segment);
  }
  return segments;
}

Instants segment_instants(const VibratoryMill& mill, const DriveSegment& segment, Eigen::Index first,
                          Eigen::Index count) {
  const double w = segment.speed_rad_s, a = segment.acceleration_rad_s2;
  const Eigen::ArrayXd tau =
      Eigen::ArrayXd::LinSpaced(count, double(first), double(first + count - 1)) * segment.step_s();
  return driven_at(mill, segment.phi_rad + tau * (w + a / 2 * tau), w + a * tau,
                   Eigen::ArrayXd::Constant(count, a));
}

}  // namespace kinetics::vibratory
