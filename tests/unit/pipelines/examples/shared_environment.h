/// MPI starts once in a process and ends once: tests that mesh or solve share it.
#pragma once

#include "pipelines/common/fem_environment.h"

namespace shared {

inline void start_fem() {
  static const pipelines::FemEnvironment environment(1);
}

}  // namespace shared
