/// Motion of the vibratory mill: what all its effects are functions of.
///
/// Frame: x right, y up; phi and chi clockwise from +x, theta counter-clockwise. Vectors are 2 x n arrays,
/// one column per instant. Symbols of the paper in brackets. The pivot E' = E + s is the eccentric's axis.
#pragma once

#include <Eigen/Core>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/mill.h"

namespace kinetics::vibratory {

/// e(a) = (cos a, -sin a): the direction at clockwise angle a.
Eigen::Array2Xd direction(const Eigen::ArrayXd& angle_rad);

/// A block of instants. In steady running both accelerations are zero; the effects do not rely on it.
struct Instants {
  Eigen::ArrayXd phi_rad;                          ///< [phi] drive angle
  Eigen::ArrayXd chi_rad;                          ///< direction of CO, chi = phi + pi - delta
  Eigen::ArrayXd speed_rad_s;                      ///< [omega_e] d phi / dt
  Eigen::ArrayXd acceleration_rad_s2;              ///< d2 phi / dt2
  Eigen::ArrayXd relative_speed_rad_s;             ///< [omega_r] d chi / dt - d phi / dt
  Eigen::ArrayXd relative_acceleration_rad_s2;     ///< d omega_r / dt
  Eigen::ArrayXd theta_rad;                        ///< pitch of the chamber about E'
  Eigen::ArrayXd theta_rad_s;                      ///< d theta / dt
  Eigen::ArrayXd theta_rad_s2;                     ///< d2 theta / dt2
  Eigen::Array2Xd along_phi = direction(phi_rad);  ///< e(phi), once for all effects
  Eigen::Array2Xd along_chi = direction(chi_rad);  ///< e(chi)

  Eigen::Index size() const { return phi_rad.size(); }
};

/// Absolute angular speed of CO, omega_e + omega_r, over that of the drive.
double charge_speed_ratio(const VibratoryMill& mill);

/// Instants first .. first + count - 1 of the grid in steady running, without pitch.
Instants steady_instants(const VibratoryMill& mill, const TimeGrid& grid, Eigen::Index first,
                         Eigen::Index count);

/// Steady running at given angles, without pitch: phi and chi need not belong to one time.
Instants steady_at(const VibratoryMill& mill, const Eigen::ArrayXd& phi_rad, const Eigen::ArrayXd& chi_rad);

/// Unsteady running at a given motion of the drive, without pitch. The charge circulates in proportion to the
/// drive: omega_r / omega_e is that of the mill at all times, and chi follows phi at that ratio.
Instants driven_at(const VibratoryMill& mill, const Eigen::ArrayXd& phi_rad,
                   const Eigen::ArrayXd& speed_rad_s, const Eigen::ArrayXd& acceleration_rad_s2);

/// Instants first .. first + count - 1 of a longer block.
Instants part_of(const Instants& all, Eigen::Index first, Eigen::Index count);

/// Instants 0, n, 2 n, ... of a longer block, `count` of them.
Instants every_nth(const Instants& all, Eigen::Index n, Eigen::Index count);
/// Puts more instants behind those that there are.
void append(Instants& all, const Instants& more);

/// a e + b n, where n(a) = (-sin a, -cos a) is the clockwise tangent of e: e' = n, n' = -e.
Eigen::Array2Xd composed(const Eigen::ArrayXd& along, const Eigen::ArrayXd& across, const Eigen::Array2Xd& e);
/// Columns scaled by one factor each.
Eigen::Array2Xd scaled(const Eigen::ArrayXd& factor, const Eigen::Array2Xd& vectors);
/// The same vector at every instant.
Eigen::Array2Xd constant(const Eigen::Vector2d& vector, Eigen::Index n);
/// z x p: p turned counter-clockwise by a right angle.
Eigen::Vector2d turned(const Eigen::Vector2d& p);
/// a_x b_y - a_y b_x, counter-clockwise positive.
Eigen::ArrayXd cross(const Eigen::Array2Xd& a, const Eigen::Array2Xd& b);

/// s = ecc e(phi), (1): the translation that the eccentric prescribes to the chamber [m].
Eigen::Array2Xd translation(const VibratoryMill& mill, const Instants& at);
/// Velocity of the translation, ds/dt [m/s].
Eigen::Array2Xd translation_velocity(const VibratoryMill& mill, const Instants& at);
/// d2s/dt2 = ecc (phi'' n(a) - phi'^2 e(a)) [m/s2], a = phi + shift; shift_rad: only for a lagging charge.
Eigen::Array2Xd translation_acceleration(const VibratoryMill& mill, const Instants& at, double shift_rad = 0);

}  // namespace kinetics::vibratory
