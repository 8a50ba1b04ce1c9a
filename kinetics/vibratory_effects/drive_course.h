/// What the drive of a vibratory mill does where its speed is not constant, as values (kinetics/run_up.h).
#pragma once

#include <optional>
#include <vector>

namespace kinetics {

/// Pitch and its rate at the start.
struct PitchState {
  double theta_rad = 0;
  double theta_rad_s = 0;
};

/// What the drive does. VibratoryMill::speed_rad_s remains the nominal speed: it gives the charge's ratio and
/// the loss angle of charge_lag, which is kept.
struct RunUp {
  std::vector<double> time_s;       ///< rising, at least two entries
  std::vector<double> speed_rad_s;  ///< >= 0, of the drive at those times; linear in between
  /// Longest step of integration; zero: 1/200 of the shortest period, of pitch or twice the fastest angle.
  double step_s = 0;
  int steps_per_instant = 1;  ///< steps of integration from one instant of the history to the next, >= 1
  std::optional<PitchState> start;  ///< default: steady running at the first speed; static balance if zero
};

}  // namespace kinetics
