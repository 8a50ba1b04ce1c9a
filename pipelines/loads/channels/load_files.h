/// The load history as files: loads.h5 for programs, loads.csv for tables.
///
/// HDF5: /time, /phi, /speed, /acceleration; /quantities/<name>; /resultants/<role>/{fx,fy,torque};
/// /effects/<effect>/<role>/{fx,fy,torque}; with bodies also /channels/<body>/<port>.<component> and
/// /effects/<effect>/<body>/<port>.<component>. Each is one number per instant with its
/// unit as attribute; machine, convention, effects and warnings belong to the file. CSV: one row per instant,
/// the same series in the same order; a title is the path without its group, so "theta [rad]", "eccentric.fx
/// [N]", "shaft/main_bearing_1.fx [N]", "charge_gravity/eccentric.fx [N]".
#pragma once

#include <filesystem>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/channels.h"

namespace pipelines {

/// Channels of bodies; none: the load stage alone.
using BodyChannels = std::vector<const ChannelHistory*>;

/// @throws StageRefused if a name is empty or has a slash; FileError naming the file if it cannot be written
void write_loads_h5(const std::filesystem::path& path, const kinetics::LoadHistory& loads,
                    const BodyChannels& bodies = {});
/// @param n_threads  that format numbers; the bytes are the same for any number
void write_loads_csv(const std::filesystem::path& path, const kinetics::LoadHistory& loads,
                     const BodyChannels& bodies = {}, int n_threads = 1);

/// Whether a file begins as those that write_loads_csv leaves, or holds what write_loads_h5 does.
bool is_loads_file(const std::filesystem::path& path);

}  // namespace pipelines
