/// The readers of the bodies that there are, each in a file of its own.
#pragma once

#include "pipelines/scene/bodies/scene_body.h"
#include "pipelines/scene/kinds/body_names.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

const BodyReader& vibratory_shaft_reader();
const BodyReader& chamber_reader();
const BodyReader& drum_reader();
const BodyReader& stub_axle_reader();
const BodyReader& train_shaft_reader();
const BodyReader& table_body_reader();

}  // namespace pipelines
