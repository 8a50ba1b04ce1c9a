#include "kinetics/vibratory/pitch_transient.h"

namespace kinetics::vibratory {

PitchTransient::PitchTransient(Eigen::Index n)
    : theta_rad(Eigen::ArrayXd::Zero(n)),
      theta_rad_s(theta_rad),
      theta_rad_s2(theta_rad),
      energy_J(theta_rad),
      work_J(theta_rad),
      dissipation_J(theta_rad) {}

PitchTransient integrate_pitch(const PitchOscillator& chamber, const Eigen::ArrayXd& moment_Nm, double step_s,
                               const PitchState& start, double work_J, double dissipation_J) {
  const double I = chamber.inertia_kg_m2, c = chamber.damping_Nm_s, k = chamber.stiffness_Nm, h = step_s;
  const Eigen::Index n = moment_Nm.size();
  PitchTransient pitch(n);
  double theta = start.theta_rad, rate = start.theta_rad_s;
  double acceleration = (moment_Nm[0] - c * rate - k * theta) / I;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) {
      const double predicted_rate = rate + h / 2 * acceleration;
      const double predicted = theta + h * (rate + h / 4 * acceleration);
      const double next = (moment_Nm[i] - c * predicted_rate - k * predicted) / (I + h / 2 * (c + h / 2 * k));
      const double mean_rate = rate + h / 4 * (acceleration + next);
      work_J += (moment_Nm[i - 1] + moment_Nm[i]) / 2 * h * mean_rate;
      dissipation_J += c * mean_rate * mean_rate * h;
      theta += h * mean_rate;
      rate += h / 2 * (acceleration + next);
      acceleration = next;
    }
    pitch.theta_rad[i] = theta;
    pitch.theta_rad_s[i] = rate;
    pitch.theta_rad_s2[i] = acceleration;
    pitch.energy_J[i] = (I * rate * rate + k * theta * theta) / 2;
    pitch.work_J[i] = work_J;
    pitch.dissipation_J[i] = dissipation_J;
  }
  return pitch;
}

}  // namespace kinetics::vibratory
