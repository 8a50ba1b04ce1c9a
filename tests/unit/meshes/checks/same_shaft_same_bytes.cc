#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "meshes/shaft/shaft.h"
#include "meshes/values/refused.h"
#include "tests/unit/meshes/examples/example_shafts.h"

namespace {

std::string bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Results are kept under a hash of what they depend on; a mesh that changed from run to run would spoil
/// that.
TEST(MshFile, IsBitIdenticalWhenRepeated) {
  const auto first = temporary_msh("first"), second = temporary_msh("second");
  meshes::build_shaft(laboratory_shaft(), {}, first);
  meshes::build_shaft(three_steps(), {}, temporary_msh("between"));  // must leave nothing behind
  meshes::build_shaft(laboratory_shaft(), {}, second);
  EXPECT_GT(bytes(first).size(), 1000000u);
  EXPECT_EQ(bytes(first), bytes(second));
}

TEST(MshFile, OfADrumIsBitIdenticalWhenRepeated) {
  const auto first = temporary_msh("first_drum"), second = temporary_msh("second_drum");
  meshes::build_shaft(planetary_drum(), {}, first);
  meshes::build_shaft(two_eccentrics(), {}, temporary_msh("between"));  // must leave nothing behind
  meshes::build_shaft(planetary_drum(), {}, second);
  EXPECT_GT(bytes(first).size(), 1000000u);
  EXPECT_EQ(bytes(first), bytes(second));
}

TEST(MshFile, LeavesNoTemporaryBesideItAndReplacesAnOldOne) {
  const auto file = temporary_msh("alone/shaft");
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "old";
  meshes::build_shaft(plain_cylinder(), {}, file);
  EXPECT_EQ(bytes(file).substr(0, 24), "$MeshFormat\n4.1 0 8\n$End");
  int n_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
    n_files += entry.is_regular_file();
  EXPECT_EQ(n_files, 1);
}

TEST(MshFile, LeavesNoTemporaryWhereItCannotStand) {
  const auto taken = temporary_msh("taken/shaft");
  std::filesystem::create_directories(taken);  // no file replaces a directory
  EXPECT_THROW(meshes::build_shaft(plain_cylinder(), {}, taken), meshes::MeshRefused);
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(taken.parent_path()))
    left.push_back(entry.path());
  EXPECT_EQ(left, std::vector{taken});
}

}  // namespace
