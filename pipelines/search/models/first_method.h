/// Which model of a body is tried first, and which one after it.
#pragma once

#include <memory>

#include "pipelines/search/models/body_model.h"

namespace pipelines {

/// The model that is asked for; with the choice left open the cheapest whose own error is within the
/// tolerance.
/// @param tolerance  of the governing stress; 0: none is asked for, and the choice is the solid
Method first_method(const Scene& scene, std::size_t i_body, double tolerance);

/// The next more expensive one: beam, harmonics around the axis, solid.
Method after(Method method);

/// Whether the model needs no cells of the whole body.
bool is_without_mesh(Method method);

/// @throws StageRefused if the method is none for the body
std::unique_ptr<BodyModel> model_of(Method method, RunOfBody run, Loaded loaded);

}  // namespace pipelines
