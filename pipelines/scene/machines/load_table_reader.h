/// The tables [machine...] of a scene whose loads the user brings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// Reads the table and closes it:
///   speed = "510 rpm"
///   [[machine.files]]      effect = "measured"  file = "belt.csv"   (pipelines/scene/tables/load_file.h)
///   [[machine.harmonics]]  effect = "imbalance" load = "disc_seat.fy" amplitude = "12 N" order = 1
///   [[machine.constants]]  effect = "weight"    load = "disc_seat.fy" value = "-30 N"
/// @param folder        folder of the scene: where files are looked for
/// @param window_turns  sampling.turns of the scene; 0: it has none
kinetics::LoadTable read_load_table(SceneTable& machine, const std::filesystem::path& folder,
                                    int window_turns, SceneFindings& findings);

/// How much of an effect's samples was read: told, since a file that is cut off at the end of a row reads
/// well.
struct SamplesRead {
  std::string effect;
  std::size_t n = 0;
  double from_deg = 0, to_deg = 0;  ///< range of the drive's angle
  std::string origin;               ///< the file, and how it was read
  int n_instants = 0;               ///< instants of the scene; 0: not told

  /// "belt: 5 rows over the drive's angle from 0 to 360 deg; log.csv: ';' with decimal comma, units in row 2,
  /// 4 of 7 columns (not used: ...), 5 rows over 0.0625 s, uneven (...); resampled to 120 instants"
  std::string text() const;
};

/// One entry for each file, in the order of the scene; none of a machine without samples.
/// @param grid  grid of the scene's instants; without one, the texts leave them out
std::vector<SamplesRead> samples_read(const Machine& machine, const kinetics::TimeGrid& grid = {1, 0});

}  // namespace pipelines
