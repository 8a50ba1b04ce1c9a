/// fem's environment for a command that has no arguments of its own to hand to MPI.
#pragma once

#include "fem/model/model.h"

namespace pipelines {

/// MPI takes half a second and may talk: only where a body is looked at.
struct FemEnvironment {
  explicit FemEnvironment(int n_threads) : environment(argc, argv, n_threads) {}
  char name[11] = "millstress";
  char* arguments[2] = {name, nullptr};
  char** argv = arguments;
  int argc = 1;
  fem::Environment environment;
};

}  // namespace pipelines
