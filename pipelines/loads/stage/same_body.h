/// Whether two versions of a scene may share what was computed of a body.
#pragma once

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// One mesh serves both: shape and mesh control are the same.
bool have_one_mesh(const BodyScene& a, const BodyScene& b);

/// The same unit loads have the same unit responses, too: material and springs under elastic feet are the
/// same. Whether the unit loads are, only the loaded bodies tell.
/// @param a, b  body `i` of either scene
bool have_one_stiffness(const Scene& a, const Scene& b, std::size_t i);

}  // namespace pipelines
