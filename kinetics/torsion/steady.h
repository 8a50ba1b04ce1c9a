/// Steady state of a reduced train: mean torque, and one frequency at a time.
#pragma once

#include <Eigen/Core>

#include "kinetics/torsion/spectrum.h"
#include "kinetics/torsion_chain/reduced.h"

namespace kinetics::torsion {

/// Response to constant torques, reduced. Exactly one of acceleration and speed may differ from zero.
struct MeanState {
  double acceleration_rad_s2 = 0;  ///< rigid, of a free train without drag
  double speed_rad_s = 0;          ///< offset at which drag balances the mean torque
  Eigen::ArrayXd angle;            ///< per node, inertia-weighted mean zero (held node zero)
  Eigen::ArrayXd torque;           ///< per edge
};

/// The rigid motion is subtracted; edge torques are then sums of loads, no stiffness matrix is solved.
/// @param load  reduced torque per node
MeanState mean_state(const ReducedTrain& reduced, const Eigen::ArrayXd& load);

struct HarmonicState {
  Eigen::ArrayXcd angle;   ///< per node, reduced
  Eigen::ArrayXcd torque;  ///< per edge, reduced, damping included
  Eigen::ArrayXcd modal;   ///< what modal damping is of that
};

/// (K - w^2 J + i w D) q = load. Without modal damping by dynamic stiffnesses along the tree, with it in
/// modal coordinates, in which the rigid mode has no stiffness at all.
/// @param spectrum  with vectors if modal_damping_ratio is not zero
HarmonicState harmonic_state(const ReducedTrain& reduced, const Spectrum& spectrum,
                             double modal_damping_ratio, double frequency_rad_s, const Eigen::ArrayXcd& load);

}  // namespace kinetics::torsion
