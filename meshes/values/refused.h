/// What the mesher throws.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace meshes {

/// A body or a mesh control that no mesh can be made of: a user's mistake. The message names part, size and
/// remedy.
class GeometryRefused : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// More cells than memory holds, known from an estimate before anything is meshed.
class TooManyCells : public GeometryRefused {
public:
  /// @param control  the field of the mesh control that asks for them, such as "size_m"
  TooManyCells(std::string control, const std::string& what)
      : GeometryRefused(what), control_(std::move(control)) {}
  const std::string& control() const noexcept { return control_; }

private:
  std::string control_;
};

/// A sound body whose mesh came out badly at this fineness (quality below what is promised, gmsh gave up, the
/// file cannot be written). Another fineness may succeed.
class MeshRefused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace meshes
