#include "meshes/gmsh_session.h"

#include <gmsh.h>

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

}  // namespace meshes
