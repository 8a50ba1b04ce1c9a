/// The environment of fem by the name that commands give it.
#pragma once

#include "fem/model/model.h"

namespace pipelines {

using FemEnvironment = fem::Environment;

}  // namespace pipelines
