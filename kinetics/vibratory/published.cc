#include "kinetics/vibratory/published.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetics/vibratory/balance.h"
#include "kinetics/vibratory_effects/kinematics.h"

namespace kinetics::vibratory {
namespace {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index block_size = 256;

/// (DE, OD), (57) and (58): where the paper puts the charge's centre, from E. Both are errata, see README.
Array2Xd published_charge_centre(const VibratoryMill& mill, const Instants& at) {
  const ArrayXd along = mill.charge_offset_m * (-at.chi_rad.cos());
  const double ecc_m = mill.eccentricity_m, JE_m = mill.chamber_centre_m.x();
  Array2Xd centre_m(2, at.size());
  centre_m.row(0) = (JE_m + 2 * ecc_m * at.phi_rad.cos() - along).transpose();  // (58)
  centre_m.row(1) = (-ecc_m * at.phi_rad.sin() - along).transpose();            // (57)
  return centre_m;
}

/// What an effect brings to the bracket of (59): its clockwise moment about E at the place that the paper
/// gives it.
ArrayXd published_moment_Nm(const VibratoryMill& mill, const std::string& effect, const PlacedForce& placed,
                            const Instants& at) {
  if (placed.place == Place::charge_centre) return -cross(published_charge_centre(mill, at), placed.force_N);
  if (placed.place == Place::structure_centre)
    return -mill.structure_centre_m.x() * placed.force_N.row(1).transpose();  // m1 g LE
  if (effect == "gravity_debalance")  // -m3 g KE cos(phi), with the sign of (59)
    return mill.debalance_offset_m * at.phi_rad.cos() * placed.force_N.row(1).transpose();
  return ArrayXd::Zero(at.size());
}

/// The force of the springs F_spr* by (59).
ArrayXd spring_force_from_moments_N(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                                    const Instants& at) {
  ArrayXd moment_Nm = ArrayXd::Zero(at.size());
  for (const NamedEffect& effect : effects)
    for (const PlacedForce& placed : effect.evaluate(at))
      moment_Nm += published_moment_Nm(mill, effect.name, placed, at);
  const double QE_m = mill.springs[0].position_m.x(), HE_m = mill.springs[1].position_m.x();
  return 2 * moment_Nm / (QE_m + HE_m);
}

/// K*, (60), with its principal value at the poles.
ArrayXd k_star_N_m(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& at,
                   const ArrayXd& force_N) {
  constexpr double h_rad = 1e-3;
  ArrayXd k(at.size());
  for (Index i = 0; i < at.size(); ++i) {
    const double phi = at.phi_rad[i], sine = std::sin(phi);
    if (std::abs(sine) > 8 * std::numeric_limits<double>::epsilon() * (1 + std::abs(phi))) {
      k[i] = force_N[i] / (mill.eccentricity_m * sine);
      continue;
    }
    const Eigen::Array2d step_rad(-h_rad, h_rad);
    const Instants beside =
        steady_at(mill, phi + step_rad, at.chi_rad[i] + charge_speed_ratio(mill) * step_rad);
    k[i] = (spring_force_from_moments_N(mill, effects, beside) / (mill.eccentricity_m * beside.phi_rad.sin()))
               .mean();
  }
  return k;
}

/// F_d, F_e, F_r, F_k and their components (45)-(50), of the effects that are on. Every component has the
/// sign that the paper gives it: X_E = -F_d cos(phi) - F_ex + F_rx + F_kx.
void write_forces(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& at,
                  LoadHistory& history) {
  const double omega_e = mill.speed_rad_s, omega_r = mill.charge_relative_speed_rad_s;
  const double m_kg = mill.charge_mass_kg, r_m = mill.charge_offset_m;
  auto& q = history.quantities;
  const auto magnitude = [&](const char* name, const char* description, double force_N) {
    q.push_back({name, "N", description, ArrayXd::Constant(at.size(), force_N)});
  };
  const auto components = [&](const std::string& name, const std::string& source_x,
                              const std::string& source_y, const ArrayXd& x, const ArrayXd& y) {
    q.push_back({name + "x", "N", "horizontal component of " + name + ", " + source_x, x});
    q.push_back({name + "y", "N", "vertical component of " + name + ", " + source_y, y});
  };
  const ArrayXd along_x = -at.along_chi.row(0).transpose();  // cos(delta - phi)
  const ArrayXd along_y = -at.along_chi.row(1).transpose();  // sin(delta - phi)
  if (contains(effects, "debalance_inertia"))
    magnitude("F_d", "inertia of the debalances, along e(phi), (33)",
              mill.debalance_mass_kg * omega_e * omega_e * mill.debalance_offset_m);
  if (contains(effects, "charge_translation")) {
    const double F_e = m_kg * omega_e * omega_e * mill.eccentricity_m;
    magnitude("F_e", "transport inertia of the charge, along e(phi), (35)", F_e);
    components("F_e", "(45)", "(46)", F_e * at.along_phi.row(0).transpose(),
               -F_e * at.along_phi.row(1).transpose());
  }
  if (contains(effects, "charge_relative")) {
    const double F_r = m_kg * omega_r * omega_r * r_m;
    magnitude("F_r", "relative inertia of the charge, along e(chi), (37)", F_r);
    components("F_r", "(47)", "(48)", F_r * along_x, F_r * along_y);
  }
  if (contains(effects, "charge_coriolis")) {
    const double F_k = 2 * m_kg * omega_e * omega_r * r_m;
    magnitude("F_k", "Coriolis force of the charge, along e(chi), (39)", F_k);
    components("F_k", "(49)", "(50)", F_k * along_x, F_k * along_y);
  }
  const Array2Xd centre_m = published_charge_centre(mill, at);
  q.push_back({"OD", "m", "arm of the charge's horizontal forces about E, (57); see the errata",
               centre_m.row(1).transpose()});
  q.push_back({"DE", "m", "arm of the charge's vertical forces about E, (58); see the errata",
               centre_m.row(0).transpose()});
}

}  // namespace

void published_over(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& all,
                    LoadHistory& history) {
  const Index n = all.size();
  Resultant frame{"frame_bearings",
                  "reaction R_E of the bearing supports on the machine, (42), (43)",
                  Array3Xd::Zero(3, n),
                  {}};
  for (std::size_t e = 0; e < effects.size(); ++e) {
    Contribution part{e, Array3Xd::Zero(3, n)};
    for (Index first = 0; first < n; first += block_size) {
      const Instants at = part_of(all, first, std::min(block_size, n - first));
      for (const PlacedForce& placed : effects[e].evaluate(at))
        part.load.topRows<2>().middleCols(first, at.size()) -= placed.force_N;
    }
    frame.total += part.load;
    frame.contributions.push_back(std::move(part));
  }
  const Array2Xd R_N = frame.total.topRows<2>();
  auto& q = history.quantities;
  q.push_back({"X_E", "N", "reaction of the bearing supports, horizontal, (42)", R_N.row(0).transpose()});
  q.push_back({"Y_E", "N", "reaction of the bearing supports, vertical, (43)", R_N.row(1).transpose()});
  q.push_back({"R_E", "N", "reaction of the bearing supports, magnitude, (44)",
               R_N.matrix().colwise().norm().transpose()});

  if (contains(effects, "springs")) {
    const auto& springs =
        std::find_if(frame.contributions.begin(), frame.contributions.end(), [&](const Contribution& c) {
          return effects[c.effect].name == "springs";
        })->load;
    const ArrayXd from_moments_N = spring_force_from_moments_N(mill, effects, all);
    q.push_back({"spring_force", "N", "force of the springs on the machine, upward, (31)",
                 -springs.row(1).transpose()});
    q.push_back({"spring_force_from_moments", "N", "the same from the moments about E, (59); see the errata",
                 from_moments_N});
    if (mill.eccentricity_m > 0) {
      q.push_back({"K_star", "N/m", "stiffness from (59), (60); where sin(phi) = 0, its principal value",
                   k_star_N_m(mill, effects, all, from_moments_N), false});
    } else {
      history.warnings.push_back("K_star (60) is left out: it divides by the eccentricity, which is zero");
    }
  }
  write_published_kinematics(mill, all, history);
  write_forces(mill, effects, all, history);
  history.resultants.push_back(std::move(frame));
}

LoadHistory published_loads(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                            const TimeGrid& grid) {
  const Instants all = steady_instants(mill, grid, 0, Index(grid.turns) * grid.instants_per_turn);
  LoadHistory history = empty_history(mill, effects, times_s(mill, all), all);
  published_over(mill, effects, all, history);
  return history;
}

}  // namespace kinetics::vibratory
