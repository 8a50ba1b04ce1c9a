/// MPI starts once in a process and ends once: tests that mesh or solve share it.
#pragma once

#include "fem/models/solid/model.h"

namespace shared {

inline void start_fem() {
  static const fem::Environment environment(1);
}

}  // namespace shared
