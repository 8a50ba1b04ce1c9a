/// Which models apply to a body.
#pragma once

#include <string>

#include "pipelines/scene/values/body_scene.h"
#include "pipelines/scene/values/method.h"

namespace pipelines {

/// Empty if the axisymmetric model applies to the body; else why not, as the end of "the shaft ...".
std::string why_not_axisymmetric(const BodyScene& body);

/// The same for a beam.
std::string why_not_beam(const BodyScene& body);

/// Empty for methods that apply to every body.
std::string why_not(Method method, const BodyScene& body);

}  // namespace pipelines
