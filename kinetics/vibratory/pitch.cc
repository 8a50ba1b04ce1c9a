#include "kinetics/vibratory/pitch.h"

#include <array>
#include <cmath>
#include <string>

#include "kinetics/values/constants.h"
#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory_effects/springs.h"

namespace kinetics::vibratory {
namespace {

using Complex = std::complex<double>;

// Forces are of degree 1 in phi and in chi, arms of degree 1 in chi: the moment has degree 2 at most, and 8
// points to a turn resolve degree 3.
constexpr int points = 8;
constexpr int highest = 3;

Instants torus(const VibratoryMill& mill) {
  Eigen::ArrayXd phi_rad(points * points), chi_rad(points * points);
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      phi_rad[i * points + j] = 2 * pi * i / points;
      chi_rad[i * points + j] = 2 * pi * j / points;
    }
  return steady_at(mill, phi_rad, chi_rad);
}

/// exp(i p a) for p = -highest .. highest, from e(a).
class Powers {
public:
  explicit Powers(const Eigen::Array2d& e) {
    const Complex z(e.x(), -e.y());
    powers_[highest] = 1;
    for (int p = 1; p <= highest; ++p) powers_[highest + p] = powers_[highest + p - 1] * z;
    for (int p = 1; p <= highest; ++p) powers_[highest - p] = std::conj(powers_[highest + p]);
  }
  Complex operator[](int p) const { return powers_[highest + p]; }

private:
  std::array<Complex, 2 * highest + 1> powers_{};
};

std::vector<Powers> powers_of(const Eigen::Array2Xd& directions) {
  std::vector<Powers> powers;
  for (Eigen::Index i = 0; i < directions.cols(); ++i) powers.emplace_back(directions.col(i));
  return powers;
}

/// Component (p, q) of the two-dimensional discrete Fourier transform of values on the torus.
Complex component(const Eigen::ArrayXd& values, const std::vector<Powers>& phi,
                  const std::vector<Powers>& chi, int p, int q) {
  Complex sum = 0;
  for (std::size_t i = 0; i < phi.size(); ++i) sum += values[Eigen::Index(i)] * (phi[i][-p] * chi[i][-q]);
  return sum / double(phi.size());
}

/// Whether (p, q) is the one that is kept of the conjugate pair (p, q), (-p, -q).
bool is_kept(int p, int q) {
  return q > 0 || (q == 0 && p >= 0);
}

std::string name_of(int p, int q, double w) {
  return number(std::abs(w)) + " rad/s = |" + std::to_string(p) + " omega_e + " + std::to_string(q) +
         " (omega_e + omega_r)|";
}

/// Amplitude of theta under a component of the moment.
Complex response(const PitchOscillator& chamber, const MomentHarmonic& forcing, double omega_e) {
  const double w = forcing.frequency_rad_s;
  if (std::abs(w) <= 1e-12 * omega_e) require_support(chamber, std::abs(forcing.moment_Nm));
  const double inertial = chamber.inertia_kg_m2 * w * w;
  const Complex denominator(chamber.stiffness_Nm - inertial, w * chamber.damping_Nm_s);
  if (std::abs(denominator) <= 1e-9 * (std::abs(chamber.stiffness_Nm) + inertial))
    refuse("natural frequency of pitch [rad/s]", std::sqrt(chamber.stiffness_Nm / chamber.inertia_kg_m2),
           "is excited exactly and undamped by the moment at " + name_of(forcing.p, forcing.q, w) +
               ": resonance; change the springs or the speed, or give the springs damping");
  return forcing.moment_Nm / denominator;
}

}  // namespace

void PitchMotion::apply(Instants& at) const {
  at.theta_rad = at.theta_rad_s = at.theta_rad_s2 = Eigen::ArrayXd::Zero(at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const Powers phi(at.along_phi.col(i)), chi(at.along_chi.col(i));
    for (const Harmonic& h : harmonics) {
      const double w = h.frequency_rad_s;
      const Complex value = h.amplitude_rad * (phi[h.p] * chi[h.q]);
      at.theta_rad[i] += value.real();
      at.theta_rad_s[i] -= w * value.imag();
      at.theta_rad_s2[i] -= w * w * value.real();
    }
  }
}

MomentSum chamber_moment(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                         const Instants& at) {
  MomentSum sum{Eigen::ArrayXd::Zero(at.size()), Eigen::ArrayXd::Zero(at.size())};
  for (const NamedEffect& effect : effects)
    for (const PlacedForce& placed : effect.evaluate(at)) {
      if (placed.place == Place::debalance) continue;
      const Eigen::Array2Xd arm_m = position(mill, placed, at);
      sum.moment_Nm += cross(arm_m, placed.force_N);
      sum.scale_Nm += (arm_m.row(0) * placed.force_N.row(1)).abs().transpose() +
                      (arm_m.row(1) * placed.force_N.row(0)).abs().transpose();
      if (placed.couple_Nm.size() > 0) {
        sum.moment_Nm += placed.couple_Nm;
        sum.scale_Nm += placed.couple_Nm.abs();
      }
    }
  return sum;
}

void require_support(const PitchOscillator& chamber, double mean_moment_Nm) {
  if (chamber.stiffness_Nm == 0)
    refuse("k_theta", chamber.stiffness_Nm,
           "the chamber's moment about the eccentric has a mean of " + number(mean_moment_Nm) +
               " N m that nothing resists; switch `springs` on and give them stiffness off the "
               "eccentric's axis, or take `pitch` out of the effects");
}

PitchOscillator pitch_oscillator(const VibratoryMill& mill, const std::vector<NamedEffect>& effects) {
  PitchOscillator chamber;
  chamber.inertia_kg_m2 = mill.pitch_inertia_kg_m2;
  if (contains(effects, "charge_follows_pitch"))
    chamber.inertia_kg_m2 += mill.charge_mass_kg * mill.chamber_centre_m.squaredNorm();
  if (contains(effects, "springs")) chamber.stiffness_Nm = pitch_stiffness_Nm(mill.springs);
  if (contains(effects, "spring_damping")) chamber.damping_Nm_s = pitch_damping_Nm_s(mill.springs);
  return chamber;
}

std::vector<MomentHarmonic> moment_harmonics(const VibratoryMill& mill,
                                             const std::vector<NamedEffect>& effects) {
  const Instants at = torus(mill);  // theta = 0: the pitch effects themselves are silent here
  const MomentSum forcing = chamber_moment(mill, effects, at);
  const double round_off_Nm = 1e-13 * forcing.scale_Nm.maxCoeff();
  const std::vector<Powers> phi = powers_of(at.along_phi), chi = powers_of(at.along_chi);
  std::vector<MomentHarmonic> harmonics;
  for (int p = -highest; p <= highest; ++p)
    for (int q = -highest; q <= highest; ++q) {
      if (!is_kept(p, q)) continue;
      const bool mean = p == 0 && q == 0;
      const Complex moment_Nm = (mean ? 1.0 : 2.0) * component(forcing.moment_Nm, phi, chi, p, q);
      if (std::abs(moment_Nm) <= round_off_Nm) continue;
      const double w = p * mill.speed_rad_s + q * mill.speed_rad_s * charge_speed_ratio(mill);
      harmonics.push_back({p, q, w, moment_Nm});
    }
  return harmonics;
}

PitchMotion solve_pitch(const VibratoryMill& mill, const std::vector<NamedEffect>& effects) {
  const PitchOscillator chamber = pitch_oscillator(mill, effects);
  PitchMotion motion;
  for (const MomentHarmonic& forcing : moment_harmonics(mill, effects))
    motion.harmonics.push_back(
        {forcing.p, forcing.q, forcing.frequency_rad_s, response(chamber, forcing, mill.speed_rad_s)});
  return motion;
}

Effect pitch(const VibratoryMill& mill) {
  const double own_kg_m2 =
      mill.pitch_inertia_kg_m2 - mill.structure_mass_kg * mill.structure_centre_m.squaredNorm();
  return [mill, own_kg_m2](const Instants& at) {
    const Eigen::Array2Xd arm_m = constant(turned(mill.structure_centre_m), at.size());
    return std::vector<PlacedForce>{{Place::structure_centre, 0,
                                     scaled(-mill.structure_mass_kg * at.theta_rad_s2, arm_m),
                                     -own_kg_m2 * at.theta_rad_s2}};
  };
}

Effect charge_follows_pitch(const VibratoryMill& mill) {
  return [mill](const Instants& at) {
    const Eigen::Array2Xd arm_m = constant(turned(mill.chamber_centre_m), at.size());
    return std::vector<PlacedForce>{
        {Place::chamber_centre, 0, scaled(-mill.charge_mass_kg * at.theta_rad_s2, arm_m), {}}};
  };
}

}  // namespace kinetics::vibratory
