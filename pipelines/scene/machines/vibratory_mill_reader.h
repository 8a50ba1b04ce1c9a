/// The tables [machine...] of a scene: a vibratory mill with an eccentric drive.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// Reads `convention`: what must be known before anything else can be judged.
kinetics::Convention read_convention(SceneTable& machine);

/// Reads the rest of the table and closes it.
/// @param effects  those that are on; they decide what is needed
/// @param masses_from_mesh  takes "structure" and "exciter" where the scene leaves them to the chamber's
/// mesh; null: there is none, and they are required
/// @return values in SI; NaN where one could not be read, with an error in the findings
kinetics::VibratoryMill read_vibratory_mill(SceneTable& machine, kinetics::Convention convention,
                                            const std::vector<std::string>& effects,
                                            std::optional<MillingSpace>& milling_space,
                                            std::vector<std::string>* masses_from_mesh);

/// Reads [machine.run_up] if it is there: from, to, duration and hold, or times and speeds.
std::optional<kinetics::RunUp> read_run_up(SceneTable& machine);

/// Share of a round chamber's cross-section that a charge fills at most, if its centre of mass lies at
/// `offset_m` from the axis: that of the circular segment with this centroid, no set of larger area has its
/// centroid so far out.
/// @param offset_m  0 to radius_m
/// @return 1 at the axis, 0 at the wall
double largest_filling(double offset_m, double radius_m);

}  // namespace pipelines
