/// The machine of a scene: one of those that kinetics knows.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "kinetics/drive_train.h"
#include "kinetics/planetary_mill.h"
#include "kinetics/table/load_table.h"
#include "kinetics/values/effect_info.h"
#include "kinetics/values/load_history.h"
#include "kinetics/vibratory_mill.h"

namespace pipelines {

/// A machine; the alternatives stand in the order of the table of kinds (scene/machines/table.cc).
using Machine =
    std::variant<kinetics::VibratoryMill, kinetics::PlanetaryMill, kinetics::DriveTrain, kinetics::LoadTable>;

/// The effects that the machine knows under its convention, in the order of summation.
std::vector<kinetics::EffectInfo> effects_of(const Machine& machine);

/// The load stage. @throws what the machine's own compute_loads throws
kinetics::LoadHistory compute_loads(const Machine& machine, const std::vector<std::string>& effects,
                                    const kinetics::TimeGrid& grid);

/// What resampling has changed in a load table's samples; none for other machines.
std::vector<kinetics::ResamplingError> resampling_errors(const Machine& machine,
                                                         const kinetics::TimeGrid& grid);

}  // namespace pipelines
