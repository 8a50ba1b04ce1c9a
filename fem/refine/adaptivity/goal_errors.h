/// What each cell contributes to the error of a stress at a place: dual weighted error estimate. Internal to
/// fem.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/base/values/stress_goal.h"
#include "fem/base/values/unit_responses.h"
#include "fem/equations/operators/stiffness.h"
#include "fem/mesh/grid/grid.h"
#include "fem/solve/solvers/mirrored_halves.h"

namespace fem {

/// The goal as a load: its virtual work with a displacement v is the goal's value for the stress of v. It has
/// no resultants.
/// @param volume_m3  integral of each node's shape function
/// @return unknowns x 1
Eigen::VectorXd dual_load(const Grid& grid, const StressGoal& goal, const std::vector<double>& volume_m3,
                          const PerCell<Lame>& elastic);

/// Products, cell by cell, of the energy norms of two errors: that of the load case, and that of the dual
/// solution (Becker and Rannacher, Acta Numerica 10, 2001, section 3; both errors by recovery, as Zienkiewicz
/// and Zhu). Their sum estimates the error of the goal from above where both recoveries are good; on the
/// first mesh and on layers of cells that have just been made smaller it may be too small.
/// @param dual  displacement, unknowns x goals, hanging nodes set
/// @param half  if load cases and dual solutions are mirror images: half of the body tells of all
/// @return cells x goals, in units of the goals
Eigen::MatrixXd goal_errors(const Grid& grid, const CellsOfNodes& cells,
                            const std::vector<CylinderChart>& charts, const PerCell<Lame>& elastic,
                            const UnitResponses& responses, const std::vector<StressGoal>& goals,
                            const Eigen::MatrixXd& dual, const MirroredHalf* half = nullptr);

}  // namespace fem
