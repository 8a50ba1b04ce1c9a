/// gmsh as a resource: started in the constructor, stopped in the destructor. gmsh is global to the process:
/// one session at a time, not from several threads. Only for .cc files.
#pragma once

#include <gmsh.h>

#include <stdexcept>
#include <string>

namespace meshes {

class GmshSession {
public:
  /// Ignores the user's own configuration and prints nothing.
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~GmshSession() {
    try {
      gmsh::finalize();
    } catch (...) {  // a destructor must not throw, and there is nothing left to save
    }
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// Runs an action in a session of its own; gmsh's errors, which are plain strings, become std::runtime_error.
template <typename Action>
void with_gmsh(const std::string& purpose, Action action) {
  try {
    const GmshSession session;
    action();
  } catch (const std::string& message) {
    throw std::runtime_error(purpose + ": gmsh says: " + message);
  }
}

}  // namespace meshes
