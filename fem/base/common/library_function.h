/// Functions that only some implementations of a library have. Internal to fem.
#pragma once

#include <dlfcn.h>

namespace fem {

/// Looked up at run time: the reference BLAS lacks OpenBLAS' functions, and both go by the name libblas.so.3;
/// an OpenMP library comes with CHOLMOD only.
/// @return null if no loaded library has it
template <typename Function>
Function* library_function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

}  // namespace fem
