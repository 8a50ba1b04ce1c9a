/// What lies between the instants of a train's steady state where these are few in the fastest harmonics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/drive_train.h"
#include "kinetics/series/course_figures.h"

namespace kinetics {

/// The loads at instants between those of the grid, twenty-four in a period of the fastest harmonic that
/// counts, where harmonics with three instants per period or fewer bring more than 0.1 % of an element's
/// torque: by three the instants' spectrum cannot tell that there is nothing above, by two the instants meet
/// a harmonic always at the same places, and nothing in their values tells.
///
/// Where no more than `most` make up the whole window, all of them, the grid's own among them at equal steps.
/// Else, by two instants per period or fewer, those at which an element's torque is larger than at any of the
/// grid; of many those that exceed most, ascending. Empty: the instants tell all harmonics that count, or
/// miss nothing.
/// @throws MachineRefused as compute_loads
std::optional<LoadHistory> loads_between_instants(const DriveTrain& train,
                                                  const std::vector<std::string>& effects,
                                                  const TimeGrid& grid, Eigen::Index most = 4096);

/// Figures over the grid's window of the angles, accelerations, torques and shear stresses of compute_loads,
/// and of what elements do to inertias. The course is evaluated at twenty-four or more instants in a period
/// of the fastest harmonic that counts, the grid's own among them, and by parabolas between them: a crest is
/// missed by 0.01 % of that harmonic. Where the accelerations' lines would need too many instants, only the
/// lines that count for torques are taken. Empty: there is no harmonic, or even these would be too many.
/// @param at_instants  what compute_loads gave for the same: where the grid is dense enough, the course is
///                     not evaluated once more
/// @throws MachineRefused as compute_loads
std::vector<CourseFigures> figures_over_the_course(const DriveTrain& train,
                                                   const std::vector<std::string>& effects,
                                                   const TimeGrid& grid,
                                                   const LoadHistory* at_instants = nullptr);

}  // namespace kinetics
