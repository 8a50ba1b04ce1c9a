/// The pitch in time: average acceleration over equal steps, with its energy.
#pragma once

#include <Eigen/Core>

#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory_effects/drive_course.h"

namespace kinetics::vibratory {

/// Pitch at the ends of steps, and what has happened to its energy since the start [J].
struct PitchTransient {
  Eigen::ArrayXd theta_rad, theta_rad_s, theta_rad_s2;
  Eigen::ArrayXd energy_J;       ///< I theta'^2 / 2 + k_theta theta^2 / 2
  Eigen::ArrayXd work_J;         ///< sum of (M_n + M_n+1) / 2 * (theta_n+1 - theta_n)
  Eigen::ArrayXd dissipation_J;  ///< sum of c_theta ((theta'_n + theta'_n+1) / 2)^2 h

  explicit PitchTransient(Eigen::Index n);
};

/// Average acceleration, Newmark's beta = 1/4 and gamma = 1/2:
///   theta'_n+1 = theta'_n + h/2 (theta''_n + theta''_n+1), theta_n+1 = theta_n + h/2 (theta'_n +
///   theta'_n+1),
/// with the equation of motion met at both ends of each step. Work and dissipation at the midpoints balance
/// the energy identically: E_n - E_0 = W_n - D_n, whatever the step.
/// @param moment_Nm  at the ends of the steps, at least one; it may jump before the first
/// @param work_J, dissipation_J  what there is of them at the start
PitchTransient integrate_pitch(const PitchOscillator& chamber, const Eigen::ArrayXd& moment_Nm, double step_s,
                               const PitchState& start, double work_J, double dissipation_J);

}  // namespace kinetics::vibratory
