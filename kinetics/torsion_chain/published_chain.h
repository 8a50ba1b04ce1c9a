/// The chain that the paper's tables are computed from, and what the tables make of it.
#pragma once

#include "kinetics/published_tables.h"

namespace kinetics::torsion {

/// Reduced to the shaft line of the first inertia; belts and gears keep their number (erratum 5), torques
/// stay real (erratum 6).
/// @throws MachineRefused as published_table_4
PublishedChain chain_of_motor(const DriveTrain& train);
/// The same of the last inertia, in reverse order, M with reversed sign.
PublishedChain chain_of_working_shaft(const DriveTrain& train);

PublishedTable table_4_of(const PublishedChain& chain);
PublishedTable table_7_of(const PublishedChain& chain);

}  // namespace kinetics::torsion
