#include "meshes/gmsh/gmsh_session.h"

#include <gmsh.h>
#include <unistd.h>

#include <system_error>
#include <utility>

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

namespace {

/// A file that is gone when this is: renamed by then, or removed.
class TemporaryFile {
public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    std::error_code ignored;  // after what is thrown already
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

}  // namespace

void write_msh_file(const std::filesystem::path& file, const std::function<void()>& fill_model) {
  const TemporaryFile temporary(file.string() + "." + std::to_string(::getpid()) + ".msh");
  const std::string purpose = "writing " + file.string();
  with_gmsh(purpose, [&] {
    fill_model();
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.Binary", 0);
    gmsh::write(temporary.path().string());
  });
  std::error_code error;
  std::filesystem::rename(temporary.path(), file, error);
  if (error)
    throw MeshRefused(purpose + ": " + error.message() + "; check that the directory exists and is writable");
}

}  // namespace meshes
