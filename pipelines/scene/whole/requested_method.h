/// The model that a run is asked for.
#pragma once

#include <string>

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// @param option  option of the command line; empty: the scene's
/// @throws std::invalid_argument naming the option, for an unknown model, a body without it, or no body
Method requested_method(const std::string& option, const Scene& scene);

}  // namespace pipelines
