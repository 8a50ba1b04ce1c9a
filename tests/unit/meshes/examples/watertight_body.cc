#include "tests/unit/meshes/examples/watertight_body.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/unit/meshes/examples/faces.h"

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

}  // namespace

void expect_watertight(const meshes::BodyMesh& body) {
  const MeshFile mesh = read_mesh_file(body);
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
