/// The tables [machine...] of a scene: a planetary mill with a belt drive.
#pragma once

#include "kinetics/planetary_mill.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// Reads `convention`.
kinetics::PlanetaryConvention read_planetary_convention(SceneTable& machine);

/// Reads the rest of the table and closes it.
/// @param effects    those that are on; they decide what is needed
/// @param drum_axes  whether the trunnions' load is wanted in axes that turn with the drum too
/// @param has_drum_body  then its mesh can tell the mass that is not given: mass_from_mesh
/// @return values in SI; NaN where one could not be read, with an error in the findings
kinetics::PlanetaryMill read_planetary_mill(SceneTable& machine, kinetics::PlanetaryConvention convention,
                                            const std::vector<std::string>& effects, bool& drum_axes,
                                            bool has_drum_body, bool& mass_from_mesh);

}  // namespace pipelines
