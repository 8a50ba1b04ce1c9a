/// The tables [machine...] of a scene whose loads the user brings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// How much of an effect's samples was read: told, since a file that is cut off at the end of a row reads
/// well.
struct SamplesRead {
  std::string effect;
  std::size_t n = 0;
  double from_deg = 0, to_deg = 0;  ///< of the drive's angle

  /// "belt: 72 rows over the drive's angle from 0 to 355 deg"
  std::string text() const;
};

/// One entry for each file, in the order of the scene; none of a machine without samples.
std::vector<SamplesRead> samples_read(const Machine& machine);

/// The SI unit of a component: "fx" and "fz" N, "torque" N m, "ax" m/s2 ...; empty if it is none.
std::string unit_of_component(const std::string& component);

}  // namespace pipelines
