/// The chamber's small pitch about the eccentric's axis E': an exact sum of harmonics of (phi, chi).
///
///   I theta'' + c_theta theta' + k_theta theta = moment about E' of the chamber's forces at theta = 0
///
/// In steady running the moment is a trigonometric polynomial of low degree in phi and chi. A component
/// (p, q) of it turns at w = p omega_e + q (omega_e + omega_r); divided by k_theta - I w^2 + i w c_theta it
/// is a component of theta. Source: ours.
#pragma once

#include <complex>
#include <vector>

#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {

/// theta = sum of Re[amplitude exp(i (p phi + q chi))]; no harmonics: theta = 0.
struct PitchMotion {
  struct Harmonic {
    int p = 0, q = 0;
    double frequency_rad_s = 0;  ///< w, signed
    std::complex<double> amplitude_rad;
  };
  std::vector<Harmonic> harmonics;

  /// Sets theta and its two derivatives from phi and chi.
  void apply(Instants& at) const;
};

/// The chamber as an oscillator about E': what resists a small pitch.
struct PitchOscillator {
  double inertia_kg_m2 = 0;  ///< I_E, with m |c|^2 if the charge follows
  double damping_Nm_s = 0;   ///< c_theta
  double stiffness_Nm = 0;   ///< k_theta
};
PitchOscillator pitch_oscillator(const VibratoryMill& mill, const std::vector<NamedEffect>& effects);

/// @throws MachineRefused if k_theta is zero: then nothing resists the mean moment
void require_support(const PitchOscillator& chamber, double mean_moment_Nm);

/// A component of the moment about E' at theta = 0: Re[moment exp(i (p phi + q chi))].
struct MomentHarmonic {
  int p = 0, q = 0;
  double frequency_rad_s = 0;  ///< w, signed
  std::complex<double> moment_Nm;
};
/// Components in steady running that are more than round-off.
std::vector<MomentHarmonic> moment_harmonics(const VibratoryMill& mill,
                                             const std::vector<NamedEffect>& effects);

/// Solves the equation of pitch for the moments of `effects`. The inertia is I_E, with m |c|^2 if
/// charge_follows_pitch is among them; stiffness and damping are those of `springs` and `spring_damping`, as
/// far as they are. Components of the moment that are zero to round-off are skipped.
/// @throws MachineRefused naming the frequency if a component meets k_theta - I w^2 + i w c_theta = 0
///         (to 1e-9 of |k_theta| + I w^2); if k_theta = 0 and the moment has a mean
PitchMotion solve_pitch(const VibratoryMill& mill, const std::vector<NamedEffect>& effects);

/// Moment about E' of the chamber's forces, counter-clockwise [N m].
struct MomentSum {
  Eigen::ArrayXd moment_Nm;
  Eigen::ArrayXd scale_Nm;  ///< sum of |x F_y| + |y F_x| + |couples|
};
MomentSum chamber_moment(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                         const Instants& at);

}  // namespace kinetics::vibratory
