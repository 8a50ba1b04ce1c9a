/// gmsh as a resource: started in the constructor, stopped in the destructor. gmsh is global to the process:
/// one session at a time, not from several threads.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "meshes/values/refused.h"

namespace meshes {

class GmshSession {
public:
  /// Ignores the user's own configuration and prints nothing.
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// Runs an action in a session of its own; gmsh's errors, which are plain strings or nothing known, become
/// MeshRefused.
template <typename Action>
void with_gmsh(const std::string& purpose, Action action) {
  try {
    const GmshSession session;
    action();
  } catch (const std::string& message) {
    throw MeshRefused(purpose + ": gmsh says: " + message);
  } catch (const std::exception&) {
    throw;
  } catch (...) {  // OpenCASCADE throws what it likes
    throw MeshRefused(purpose + ": gmsh gave up without a word");
  }
}

/// Fills a model in a session of its own and writes it as .msh 4.1, through a temporary name; nothing is
/// left under that name if this throws.
/// @throws MeshRefused naming the file
void write_msh_file(const std::filesystem::path& file, const std::function<void()>& fill_model);

}  // namespace meshes
