#include "kinetics/vibratory/published.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinetics/vibratory/balance.h"

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

/// F_spr*, (59)
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

void write_accelerations(const VibratoryMill& mill, const Instants& at, LoadHistory& history) {
  const double omega_e = mill.speed_rad_s, omega_r = mill.charge_relative_speed_rad_s;
  const double a_C = omega_e * omega_e * mill.eccentricity_m;       // (16)
  const double a_OC = omega_r * omega_r * mill.charge_offset_m;     // (20)
  const double a_k = 2 * omega_e * omega_r * mill.charge_offset_m;  // (24)
  const ArrayXd delta = at.phi_rad + std::acos(-1.0) - at.chi_rad;
  const ArrayXd a_n = -a_C * delta.cos() + a_OC + a_k, a_xi = a_C * delta.sin();
  auto& q = history.quantities;
  q.push_back({"chi", "rad", "direction of the charge's centre from C, clockwise: phi + pi - delta, (4)",
               at.chi_rad});
  q.push_back({"a_n", "m/s2", "acceleration of the charge's centre, towards C, (25)", a_n});
  q.push_back({"a_xi", "m/s2", "acceleration of the charge's centre, across CO, (26)", a_xi});
  q.push_back({"a_O", "m/s2", "acceleration of the charge's centre, magnitude, (27)",
               (a_n.square() + a_xi.square()).sqrt()});
}

}  // namespace

void published_over(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& all,
                    LoadHistory& history) {
  const Index n = all.size();
  Resultant frame{"frame_bearings",
                  "reaction R_E of the bearing supports on the machine, (42), (43)",
                  Array3Xd::Zero(3, n),
                  {}};
  for (const NamedEffect& effect : effects) {
    Contribution part{effect.name, Array3Xd::Zero(3, n)};
    for (Index first = 0; first < n; first += block_size) {
      const Instants at = part_of(all, first, std::min(block_size, n - first));
      for (const PlacedForce& placed : effect.evaluate(at))
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
        std::find_if(frame.contributions.begin(), frame.contributions.end(), [](const Contribution& c) {
          return c.effect == "springs";
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
  write_accelerations(mill, all, history);
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
