/// The material of a body in a scene: `material = "S355"` or the table [<body>.material].
#pragma once

#include <string>

#include "pipelines/scene/bodies/scene_body.h"

namespace pipelines {

/// What the material says of the body's strength beside BodyScene::yield_strength_Pa.
struct KnownStrength {
  double tensile_Pa = 0;  ///< R_m; 0: not known; NaN: could not be read, with an error in the findings
  MaterialGroup group = MaterialGroup::steel;
  std::string source;    ///< source of R_m: "C45+N, above 16 to 100 mm, EN 10083-2"; empty: the scene
  std::string why_none;  ///< no R_m is known, and what adds it; empty: it is known
};

/// Reads the material into the body: its keys, and for those that are left out the library's values
/// (scene/materials/material_library.h) of the body's size, recorded as defaults. The size is the thickest
/// solid section of a contour (diameter less bore), the thickest plate of a chamber, or the key `thickness`;
/// of a body from a file without it the weakest range counts.
/// @param body  with its shape
KnownStrength read_material(SceneTable& table, BodyScene& body, SceneFindings& findings);

}  // namespace pipelines
