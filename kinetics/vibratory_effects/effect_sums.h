/// What the balance collects over the instants, before it becomes quantities.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_effects/effect.h"

namespace kinetics::vibratory {

/// Forces on one body, summed; the scales are sums of magnitudes.
struct BodySums {
  Eigen::Array2Xd force_N;
  Eigen::ArrayXd force_scale_N, moment_Nm, moment_scale_Nm;  ///< moment about E' (chamber) or E (shaft)

  explicit BodySums(Eigen::Index n);
  /// Adds a force at an arm to the instants from `first` on.
  void add(Eigen::Index first, const Eigen::Array2Xd& arm_m, const Eigen::Array2Xd& force_N);
  void add_couple(Eigen::Index first, const Eigen::ArrayXd& couple_Nm);
};

/// Roles of the sums in the order of the documentation; the feet of the springs are the last.
enum RoleIndex : std::size_t {
  eccentric,
  debalance,
  frame_bearings,
  drive,
  housing_bore,
  inner_wall,
  first_spring_foot
};

/// What one effect brings to one role. Columns are written once, block by block: storing them is most of the
/// work of an instant.
struct Share {
  Eigen::Array3Xd load;       ///< rows fx, fy, torque; empty: the effect does not load the role
  Eigen::Index n_filled = 0;  ///< columns from the left that are written
};

/// Some columns of a load.
using Columns = Eigen::Block<Eigen::Array3Xd, 3, Eigen::Dynamic, true>;

struct Role {
  std::string name, description;
  Eigen::Array3Xd total;
  std::vector<Share> shares;  ///< by effect
};

/// Sums over all instants of a motion, which must outlive them. Blocks are added in the order of time.
struct EffectSums {
  EffectSums(const VibratoryMill& mill, std::size_t n_effects, const Instants& instants);

  const Instants& motion;
  std::vector<Role> roles;  ///< by RoleIndex
  BodySums chamber, shaft;
  Eigen::ArrayXd charge_power_W, damping_power_W, couple_Nm;

  /// An effect's share of a role at the instants first .. first + count - 1, to be filled completely.
  Columns to_fill(std::size_t role, std::size_t effect, Eigen::Index first, Eigen::Index count);
  /// The same, to be added to: zero at first.
  Columns to_add(std::size_t role, std::size_t effect, Eigen::Index first, Eigen::Index count);
  /// The roles as resultants, which takes them out of the sums. Those that only carry an effect's own load
  /// are left out if nothing was posted to them.
  std::vector<Resultant> take_resultants();
};

/// Turns the collected sums into the history's resultants and quantities, with warnings.
void write_results(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, EffectSums& sums,
                   LoadHistory& history);

}  // namespace kinetics::vibratory
