/// Loads of a train as a history has them: what each excitation brings alone, written out by roles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/drive_train.h"

namespace kinetics::torsion {

/// One effect and the motion that it brings alone.
struct LoadPart {
  std::string effect;
  std::optional<Eigen::Index> inertia;  ///< the inertia that its torque acts on; none: initial values
  TrainMotion motion;
  Eigen::ArrayXd torque_Nm;  ///< torque of the effect itself on that inertia
};

/// Adds to a history, whose instants it has, the quantities and resultants of every inertia and element that
/// `compute_loads` lists, with the parts as contributions: the effects of the history begin with those of the
/// parts.
/// @param sum         motion of all parts together
/// @param angle_text  what <inertia>.angle is measured from
void write_parts(const DriveTrain& train, const TrainMotion& sum, const std::vector<LoadPart>& parts,
                 const std::string& angle_text, LoadHistory& history);

/// Adds the quantity "closure": |sum of torques - J phi''| over their largest sum of sizes, the worst inertia
/// at each instant; a held one has a reaction.
void write_closure(const DriveTrain& train, LoadHistory& history);

}  // namespace kinetics::torsion
