/// A body whose loads the user brings in a table.
#pragma once

#include <string>
#include <vector>

#include "kinetics/table/load_table.h"
#include "kinetics/values/load_history.h"
#include "pipelines/loads/channels/load_collector.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

/// Every load of the table goes to the port of its name, "volume" being the body itself (ax, ay, az, spin).
/// What does not close is balanced by the supports that the scene names, effect by effect.
/// @throws StageRefused if a port is missing, or a component does not belong to it
/// @param phi_rad  angles of the drive, those of the grid or others
BodyLoads distribute_table_at(const Eigen::ArrayXd& phi_rad, const kinetics::LoadTable& table,
                              const std::vector<std::string>& effects, const kinetics::TimeGrid& grid,
                              const LoadedBody& body, const TableBodyOptions& options);

const LoadMaker& table_body_loads();

}  // namespace pipelines
