/// What cases of scenes share.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/scene/whole/scene.h"

namespace fuzz {

/// Few instants, but the whole period where a table needs it.
kinetics::TimeGrid few_instants(const pipelines::Scene& scene);

/// Reads a scene as far as its summary. @return the fault
std::string fault_of_scene(const std::filesystem::path& file);

}  // namespace fuzz
