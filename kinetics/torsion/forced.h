/// A train made ready once for many steady states.
#pragma once

#include <string>
#include <vector>

#include "kinetics/drive_train.h"
#include "kinetics/torsion/spectrum.h"
#include "kinetics/torsion_chain/excitation.h"
#include "kinetics/torsion_chain/reduced.h"

namespace kinetics::torsion {

/// The train, reduced, with its modes; vectors only where damping asks for them.
struct PreparedTrain {
  explicit PreparedTrain(const DriveTrain& given);
  DriveTrain train;
  ReducedTrain reduced;
  Spectrum spectrum;
};

/// Response to some excitations of the train; resonances are not checked here. Warns where modal damping,
/// of which nobody knows the place, changes an element's largest torque by more than 5 %, and of constant
/// torques that do not balance.
ForcedResponse respond(const PreparedTrain& prepared, const Spectral& excitation);

/// Damping ratio of a mode, from all kinds of damping.
double damping_ratio(const PreparedTrain& prepared, Index mode);

/// Sentences about lines within 10 % of a natural frequency, with the amplification.
/// @throws MachineRefused for a line at a natural frequency (to 1e-12) whose mode nothing damps
std::vector<std::string> resonance_warnings(const PreparedTrain& prepared,
                                            const std::vector<TorqueLine>& lines);

}  // namespace kinetics::torsion
