/// Load history: what the kinetics stage hands on, and the only thing that leaves it.
///
/// Conventions of all machines: x to the right, y up, z along the shaft towards the reader; forces in the
/// fixed frame, but the planetary mill's in the frame of its carrier; a torque is the moment about +z,
/// counter-clockwise positive. SI units; a column per instant.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace kinetics {

/// Equidistant instants over whole turns of the drive: t_i = i T / n, i = 0 .. turns * n - 1, T one turn.
struct TimeGrid {
  int turns = 1;                ///< turns of the drive covered, >= 1
  int instants_per_turn = 120;  ///< n, >= 4
};

/// @throws MachineRefused if turns < 1 or instants_per_turn < 4
void check_grid(const TimeGrid& grid);

/// One scalar of the machine over time: no load by itself, or a derived load figure (theta, T, R_E ...).
struct Quantity {
  std::string name;            ///< as in the machine's documentation: "theta", "T", "R_E", "spring_1.fx" ...
  std::string unit;            ///< SI unit: "N", "N m", "rad", "W" ...
  std::string description;     ///< one line, with the equation number of the source
  Eigen::ArrayXd values;       ///< n_instants
  bool has_statistics = true;  ///< false: it has poles, so that its extremes and means say nothing
};

/// The part of a resultant that one effect brings.
struct Contribution {
  std::size_t effect = 0;  ///< index in LoadHistory::effects
  Eigen::Array3Xd load;    ///< rows fx [N], fy [N], torque [N m]; 3 x n_instants
};

/// A planar load resultant by its role in the machine ("eccentric", "debalance" ...): a force through the
/// role's reference point and a torque about it. `contributions` add up to `total`.
struct Resultant {
  std::string role;
  std::string description;  ///< on which body it acts, and through which point
  Eigen::Array3Xd total;    ///< rows fx [N], fy [N], torque [N m]; 3 x n_instants
  std::vector<Contribution> contributions;
};

/// Everything the kinetics stage says about one run. Value type; columns of all members belong to time_s.
struct LoadHistory {
  std::string machine;
  std::string convention;
  /// Names of the effects that were evaluated, in the order of summation, and of what balances a machine in
  /// the place of one that is off ("drive_couple").
  std::vector<std::string> effects;
  std::vector<std::string> warnings;  ///< sentences for the user (large pitch, reversed torque ...)
  Eigen::ArrayXd time_s;              ///< n_instants
  Eigen::ArrayXd phi_rad;      ///< drive angle: clockwise (vibratory mill), counter-clockwise (planetary)
  Eigen::ArrayXd speed_rad_s;  ///< d phi / dt
  Eigen::ArrayXd acceleration_rad_s2;  ///< d2 phi / dt2
  std::vector<Quantity> quantities;
  std::vector<Resultant> resultants;

  /// @throws std::out_of_range naming the quantity if there is none of that name
  const Quantity& quantity(const std::string& name) const;
  /// @throws std::out_of_range naming the role if there is none of that name
  const Resultant& resultant(const std::string& role) const;
  bool has_resultant(const std::string& role) const;
  Eigen::Index n_instants() const { return time_s.size(); }
};

}  // namespace kinetics
