#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "meshes/gmsh/msh_writer.h"
#include "meshes/shaft/shaft.h"
#include "meshes/values/refused.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"

namespace {

/// Results are kept under a hash of what they depend on; a mesh that changed from run to run would spoil
/// that.
TEST(MshFile, IsBitIdenticalWhenRepeated) {
  const auto first = msh_bytes(meshes::build_shaft(laboratory_shaft(), {}));
  msh_bytes(meshes::build_shaft(three_steps(), {}));  // must leave nothing behind
  EXPECT_GT(first.size(), 1000000u);
  EXPECT_TRUE(msh_bytes(meshes::build_shaft(laboratory_shaft(), {})) == first);
}

TEST(MshFile, OfADrumIsBitIdenticalWhenRepeated) {
  const auto first = msh_bytes(meshes::build_shaft(planetary_drum(), {}));
  msh_bytes(meshes::build_shaft(two_eccentrics(), {}));  // must leave nothing behind
  EXPECT_GT(first.size(), 1000000u);
  EXPECT_TRUE(msh_bytes(meshes::build_shaft(planetary_drum(), {})) == first);
}

/// What fem computes on is what a user opens: the same places to the file's 16 digits, the same cells and
/// groups.
TEST(MshFile, HoldsTheCellsOfTheBody) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  const auto& cells = *body.cells;
  const auto read = read_mesh_file(body);
  ASSERT_EQ(read.points.size(), cells.points.size());
  for (std::size_t i = 0; i < read.points.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) ASSERT_NEAR(read.points[i][d], cells.points[i][d], 1e-15);
  ASSERT_EQ(read.hexes.size(), cells.n_cells());
  for (std::size_t c = 0; c < read.hexes.size(); ++c) {
    ASSERT_EQ(read.hexes[c].group, cells.volume_id[c]);
    for (std::size_t i = 0; i < 8; ++i) ASSERT_EQ(read.hexes[c].nodes[i], cells.cell(c)[i]);
  }
  EXPECT_EQ(read.quads.size(), cells.n_faces());
  EXPECT_EQ(read.volume_names, body.groups.volumes);
  EXPECT_EQ(read.boundary_names, body.groups.boundaries);
}

TEST(MshFile, LeavesNoTemporaryBesideItAndReplacesAnOldOne) {
  const auto file = temporary_msh("alone/shaft");
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "old";
  meshes::write_msh(meshes::build_shaft(plain_cylinder(), {}), file);
  std::string line;
  std::ifstream written(file);
  std::getline(written, line);
  EXPECT_EQ(line, "$MeshFormat");
  std::getline(written, line);
  EXPECT_EQ(line, "4.1 0 8");
  int n_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
    n_files += entry.is_regular_file();
  EXPECT_EQ(n_files, 1);
}

TEST(MshFile, LeavesNoTemporaryWhereItCannotStand) {
  const auto taken = temporary_msh("taken/shaft");
  std::filesystem::create_directories(taken);  // no file replaces a directory
  EXPECT_THROW(meshes::write_msh(meshes::build_shaft(plain_cylinder(), {}), taken), meshes::MeshRefused);
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(taken.parent_path()))
    left.push_back(entry.path());
  EXPECT_EQ(left, std::vector{taken});
}

TEST(MshFile, NamesThePlaceWhereItCannotBeWritten) {
  const auto file = temporary_msh("x").parent_path() / "no_such_directory" / "shaft.msh";
  try {
    meshes::write_msh(meshes::build_shaft(plain_cylinder(), {}), file);
    ADD_FAILURE() << "was written";
  } catch (const meshes::MeshRefused& error) {
    EXPECT_NE(std::string(error.what()).find("no_such_directory"), std::string::npos) << error.what();
  }
}

}  // namespace
