/// Effects that more than one file of this folder asks for by name: a misspelt one does not compile. Which
/// effects there are, and what they are, is said by the tables of kinetics and by own_effects of the bodies.
#pragma once

namespace pipelines::effect_name {

// Effects of the vibratory mill.
inline constexpr const char *gravity_structure = "gravity_structure", *gravity_exciter = "gravity_exciter",
                            *structure_inertia = "structure_inertia", *exciter_inertia = "exciter_inertia",
                            *charge_lag = "charge_lag", *springs = "springs",
                            *spring_damping = "spring_damping", *pitch = "pitch";

// Effects of the planetary mill. The charge's offset has another name under the paper's conventions.
inline constexpr const char *drum_gravity = "drum_gravity", *drum_transport = "drum_transport",
                            *charge_offset = "charge_offset", *charge_relative = "charge_relative",
                            *belt = "belt";

// Effects of the shafts of vibratory mills and of drive trains themselves.
inline constexpr const char* shaft_inertia = "shaft_inertia";

}  // namespace pipelines::effect_name
