/// What the mesher throws.
#pragma once

#include <stdexcept>

namespace meshes {

/// A body or a mesh control that no mesh can be made of: a user's mistake. The message names part, size and
/// remedy.
class GeometryRefused : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// A sound body whose mesh came out badly at this fineness (quality below what is promised, gmsh gave up, the
/// file cannot be written). Another fineness may succeed.
class MeshRefused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace meshes
