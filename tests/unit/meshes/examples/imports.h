/// Files of other programs' making, and imports of them on coarse cells.
#pragma once

#include <gmsh.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "meshes/gmsh/gmsh_session.h"
#include "meshes/imported/imported.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

inline constexpr int cells_around = 10;  // a circle: coarse, for speed

/// Runs a construction in a session of its own and writes what it left.
inline std::filesystem::path written(const std::string& name, const std::function<void()>& construct) {
  auto file = temporary_msh("sample").parent_path() / name;
  meshes::with_gmsh("making a sample", [&] {
    gmsh::model::add("sample");
    construct();
    gmsh::write(file.string());
  });
  return file;
}

/// A port of the surfaces between two heights.
inline meshes::ImportPort box(const std::string& name, double low_z_m, double high_z_m) {
  return {name, meshes::Port::Kind::face, meshes::BoxSelection{{-1, -1, low_z_m}, {1, 1, high_z_m}}};
}

inline meshes::Import import_of(const std::filesystem::path& geometry,
                                const std::vector<meshes::ImportPort>& ports) {
  meshes::Import import;
  import.geometry = geometry;
  import.ports = ports;
  import.control.cells_per_circle = cells_around;
  return import;
}

/// What the import of it is refused with, or nothing.
inline std::string refused(meshes::Import import) {
  import.control.smallest_size_m = 0.006;  // a few hundred cells
  return refusal_of([&] { meshes::build_imported(import); });
}
