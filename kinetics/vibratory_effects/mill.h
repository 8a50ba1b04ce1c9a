/// The vibratory mill as values. Its mechanics, frames and source: kinetics/vibratory_mill.h.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "kinetics/values/effect_info.h"

namespace kinetics {

/// `published`: the paper's formulas to the letter. `consistent`: mechanics that closes to round-off.
enum class Convention { published, consistent };

/// One spring support of the chamber.
struct Spring {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();     ///< from E' in the chamber's rest attitude
  Eigen::Vector2d stiffness_N_m = Eigen::Vector2d::Zero();  ///< (kx, ky), >= 0
  Eigen::Vector2d damping_N_s_m = Eigen::Vector2d::Zero();  ///< (cx, cy), >= 0
  std::optional<Eigen::Vector2d> preload_N;  ///< force at rest; default: static balance of the weights
};

/// Charge lag (effect `charge_lag`): exactly one of the two is given when the effect is on.
struct ChargeLag {
  std::optional<double> loss_angle_rad;    ///< eta
  std::optional<double> grinding_power_W;  ///< P, sin(eta) = P / (m ecc^2 omega_e^3)
};

/// Parameters of the machine. Names of the paper in brackets. A mass may be zero where no effect that is on
/// uses it.
struct VibratoryMill {
  Convention convention = Convention::consistent;
  double gravity_m_s2 = 9.81;
  double eccentricity_m = 0;               ///< [C1C] ecc, >= 0
  double speed_rad_s = 0;                  ///< [omega_e] drive speed, > 0
  double initial_angle_rad = 0;            ///< [phi0]
  double charge_relative_speed_rad_s = 0;  ///< [omega_r] of CO relative to a frame that turns with the drive
  double charge_initial_angle_rad = 0;     ///< [delta0]
  double charge_offset_m = 0;              ///< [CO] r, >= 0
  double charge_mass_kg = 0;               ///< [m]
  double structure_mass_kg = 0;            ///< [m1] chamber
  double exciter_mass_kg = 0;              ///< [m2] exciter housing
  double debalance_mass_kg = 0;            ///< [m3] debalances only, not the shaft
  double debalance_offset_m = 0;           ///< [KE], signed along C1C: negative for counterweights
  Eigen::Vector2d chamber_centre_m = Eigen::Vector2d::Zero();    ///< c, from E'; its x is [JE]
  Eigen::Vector2d structure_centre_m = Eigen::Vector2d::Zero();  ///< l, from E'; its x is [LE]
  double pitch_inertia_kg_m2 = 0;  ///< I_E about E', structure and exciter housing, not the charge
  std::vector<Spring> springs;     ///< `published` needs two; the x of their positions are [QE], [HE]
  ChargeLag charge_lag;
};

/// The effects that the machine knows under a convention, in the order of summation.
const std::vector<EffectInfo>& vibratory_mill_effects(Convention convention);

}  // namespace kinetics
