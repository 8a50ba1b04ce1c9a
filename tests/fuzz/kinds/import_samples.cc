#include "tests/fuzz/kinds/import_samples.h"

#include <gmsh.h>

#include <vector>

namespace fuzz {

void write_import_samples(const std::filesystem::path& directory) {
  namespace occ = gmsh::model::occ;
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::vectorpair parts;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, occ::addBox(0, 0, 0, 30, 30, 20)}}, {{3, occ::addCylinder(15, 15, -1, 0, 0, 22, 5)}}, parts,
           map);
  occ::synchronize();
  gmsh::write((directory / "sound.step").string());
  gmsh::option::setNumber("Mesh.MeshSizeMax", 12);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 6);
  gmsh::model::mesh::generate(3);
  for (const double version : {4.1, 2.2}) {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::write((directory / (version > 4 ? "sound_41.msh" : "sound_22.msh")).string());
  }
  gmsh::finalize();
}

}  // namespace fuzz
