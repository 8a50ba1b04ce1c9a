/// The tables [machine...] of a scene whose loads the user brings.
#pragma once

#include <filesystem>

#include "pipelines/scene/scene_table.h"

namespace pipelines {

/// Reads the table and closes it:
///   speed = "510 rpm"
///   [[machine.files]]      effect = "measured"  file = "belt.csv"   (pipelines/files/table_file.h)
///   [[machine.harmonics]]  effect = "imbalance" load = "disc_seat.fy" amplitude = "12 N" order = 1
///   [[machine.constants]]  effect = "weight"    load = "disc_seat.fy" value = "-30 N"
/// A file has a column "time" or "angle", then one per load, "<port>.<component> [unit]".
/// @param folder  of the scene: where files are looked for
kinetics::LoadTable read_load_table(SceneTable& machine, const std::filesystem::path& folder,
                                    SceneFindings& findings);

/// The SI unit of a component: "fx" and "fz" N, "torque" N m, "ax" m/s2 ...; empty if it is none.
std::string unit_of_component(const std::string& component);

}  // namespace pipelines
