#include <gtest/gtest.h>

#include <set>

#include "tests/unit/meshes/example_shafts.h"
#include "tests/unit/meshes/faces.h"

namespace {

/// Divergence theorem: the volume enclosed by outward quads, each split into four triangles about its centre
/// (the mean of the two ways to split a bilinear face along a diagonal encloses the same volume as the
/// bilinear face itself).
double enclosed_volume(const MeshFile& mesh) {
  const auto triple = [](const auto& a, const auto& b, const auto& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  double volume = 0;
  for (const auto& quad : mesh.quads) {
    const auto &a = mesh.points[quad.nodes[0]], &b = mesh.points[quad.nodes[1]],
               &c = mesh.points[quad.nodes[2]], &d = mesh.points[quad.nodes[3]];
    volume += (triple(a, b, c) + triple(a, c, d) + triple(a, b, d) + triple(b, c, d)) / 12;
  }
  return volume;
}

void expect_watertight(const meshes::Shaft& shaft, const meshes::ShaftMeshControl& control,
                       const std::string& name) {
  SCOPED_TRACE(name);
  const auto body = meshes::build_shaft(shaft, control, temporary_msh(name));
  const MeshFile mesh = read_mesh_file(body.file);
  const auto faces = count_faces(mesh);

  std::map<FaceKey, int> quads;
  for (const auto& quad : mesh.quads) ++quads[key_of(quad.nodes)];
  std::size_t n_free = 0;
  for (const auto& [key, use] : faces) {
    ASSERT_LE(use.n_cells, 2) << "a face shared by more than two cells";
    if (use.n_cells == 2) continue;
    ++n_free;
    ASSERT_EQ(quads.count(key), 1u) << "a free face without a boundary quad at z = " << mesh.z(key[0]);
  }
  EXPECT_EQ(quads.size(), n_free) << "a boundary quad that is no free face";
  for (const auto& [key, n] : quads) EXPECT_EQ(n, 1) << "a boundary face in two groups";

  std::set<int> used;
  for (const auto& hex : mesh.hexes) used.insert(hex.nodes.begin(), hex.nodes.end());
  EXPECT_EQ(used.size(), mesh.points.size()) << "nodes without a cell";
  EXPECT_EQ(mesh.points.size(), body.quality.n_vertices);
  EXPECT_EQ(mesh.hexes.size(), body.quality.n_cells);

  // Both are exact for the trilinear body; sums of some 1e4 terms round at 1e-13. An inward quad or a gap
  // shows at 1e-4.
  const double volume = volume_and_moments(mesh)[0];
  EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-11 * volume);
}

TEST(ShaftMesh, is_watertight_with_every_free_face_in_exactly_one_group) {
  meshes::ShaftMeshControl control;
  expect_watertight(laboratory_shaft(), control, "laboratory");
  expect_watertight(plain_cylinder(), control, "cylinder");
  expect_watertight(three_steps(), control, "three_steps");
  expect_watertight(sharp_eccentric_shaft(), control, "sharp_eccentric");
  expect_watertight(shoulder_shaft(1.1, 0.05), control, "fillet_as_high_as_the_step");
  expect_watertight(shoulder_shaft(2, 0.2), control, "deep_fillet");
}

TEST(ShaftMesh, is_watertight_with_bores_grooves_and_several_eccentrics) {
  for (const int cells : {2, 6})
    for (const int sectors : {8, 24}) {
      meshes::ShaftMeshControl control;
      control.cells_per_fillet_quarter = cells;
      control.n_sectors = sectors;
      expect_watertight(planetary_drum(), control, "drum");
      expect_watertight(two_eccentrics(), control, "two_eccentrics");
      expect_watertight(grooved_shaft(), control, "grooved");
      for (const auto& shaft : stepped_bores()) expect_watertight(shaft, control, "stepped_bore");
    }
}

TEST(ShaftMesh, is_watertight_at_other_resolutions) {
  for (const int cells : {2, 4, 16})
    for (const int sectors : {8, 12, 20, 32}) {
      meshes::ShaftMeshControl control;
      control.cells_per_fillet_quarter = cells;
      control.n_sectors = sectors;
      expect_watertight(laboratory_shaft(), control, std::to_string(cells) + "_" + std::to_string(sectors));
    }
}

}  // namespace
