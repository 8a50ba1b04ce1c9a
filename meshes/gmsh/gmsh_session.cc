#include "meshes/gmsh/gmsh_session.h"

#include <gmsh.h>
#include <unistd.h>

#include <system_error>

#include "meshes/values/refused.h"

namespace meshes {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
}

GmshSession::~GmshSession() {
  try {
    gmsh::finalize();
  } catch (...) {  // a destructor must not throw, and there is nothing left to save
  }
}

void write_msh_file(const std::filesystem::path& file, const std::function<void()>& fill_model) {
  const std::filesystem::path temporary = file.string() + "." + std::to_string(::getpid()) + ".msh";
  const std::string purpose = "writing " + file.string();
  with_gmsh(purpose, [&] {
    fill_model();
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.Binary", 0);
    gmsh::write(temporary.string());
  });
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error)
    throw MeshRefused(purpose + ": " + error.message() + "; check that the directory exists and is writable");
}

}  // namespace meshes
