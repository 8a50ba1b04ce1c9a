// Shafts, drums and chambers drawn at random, a twentieth of their cells cut at random: no cell is inverted,
// what is rigid stays so, and a linear displacement is in equilibrium. MILLSTRESS_REFINED_BODIES says how
// many of each kind (default 3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>

#include "fem/base/values/errors.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "meshes/chamber/chamber.h"
#include "meshes/shaft/shaft.h"
#include "meshes/values/refused.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/meshes/examples/random_bodies.h"

namespace {

int n_refined_bodies() {
  const char* asked = std::getenv("MILLSTRESS_REFINED_BODIES");
  return asked != nullptr ? std::atoi(asked) : 3;
}

/// Reads the mesh with cells cut at random, and those beside them where that inverts cells; throws where one
/// stays inverted.
fem::Grid with_cells_cut(const meshes::BodyMesh& mesh, std::mt19937& random, int& n_mended) {
  auto body = fem_tests::steel_body(mesh);
  const auto n_cells = fem::make_grid(body).n_cells();
  std::vector<std::int32_t> cut;
  for (std::size_t c = 0; c < n_cells; ++c)
    if (random() % 20 == 0) cut.push_back(std::int32_t(c));
  if (cut.empty()) cut = {0};
  body.refinements = {{cut}};
  while (true) {
    try {
      return fem::make_grid(body);
    } catch (const fem::InvertedBesideLarger& inverted) {
      if (body.refinements.size() > 10) throw;
      body.refinements.push_back({inverted.larger()});
      ++n_mended;
    }
  }
}

/// Forces of the rigid rotations, and inside the body of a linear displacement, relative to those of that
/// displacement on the surface.
struct Forces {
  double rotation = 0, patch = 0;
};

Forces relative_forces(const fem::Grid& grid) {
  const Eigen::Index n = 3 * Eigen::Index(grid.n_nodes);
  Eigen::Matrix3d gradient;
  gradient << 1, 0.3, -0.2, 0.7, -0.4, 0.1, -0.5, 0.6, 0.8;
  Eigen::MatrixXd displacement(n, 4);
  displacement.leftCols<3>() = fem::rigid_modes(grid, Eigen::Vector3d::Zero()).rightCols<3>();
  for (std::size_t i = 0; i < grid.n_nodes; ++i)
    displacement.col(3).segment<3>(3 * Eigen::Index(i)) =
        gradient * Eigen::Vector3d(grid.position(std::int32_t(i)));
  displacement.colwise().normalize();
  Eigen::MatrixXd force = fem_tests::stiffness_times(grid, displacement);
  const double scale = force.col(3).norm();
  for (const auto& face : grid.boundary)
    for (const int i : fem::face_nodes(grid.shape(), face.face))
      force.col(3).segment<3>(3 * Eigen::Index(grid.nodes_of(std::size_t(face.cell))[i])).setZero();
  return {force.leftCols<3>().colwise().norm().maxCoeff() / scale, force.col(3).norm() / scale};
}

/// What the bodies of one kind have shown.
struct Seen {
  Forces worst;
  std::size_t most_nodes = 0, n_hanging = 0;
  int n_mended = 0;
};

/// Rounding leaves less than 1e-12, or, where walls are so thin beside the body that the mesh before the cut
/// has more, at most three times as much as that.
void examine(const meshes::BodyMesh& mesh, std::mt19937& random, Seen& seen) {
  constexpr double rounding = 1e-12;
  const auto grid = with_cells_cut(mesh, random, seen.n_mended);
  const auto cut = relative_forces(grid);
  if (cut.rotation > rounding || cut.patch > rounding) {
    const auto whole = relative_forces(fem::make_grid(fem_tests::steel_body(mesh)));
    EXPECT_LT(cut.rotation, std::max(rounding, 3 * whole.rotation));
    EXPECT_LT(cut.patch, std::max(rounding, 3 * whole.patch));
  }
  seen.worst = {std::max(seen.worst.rotation, cut.rotation), std::max(seen.worst.patch, cut.patch)};
  seen.most_nodes = std::max(seen.most_nodes, grid.n_nodes);
  seen.n_hanging += grid.hanging.n();
}

void tell(const Seen& seen, const char* kind) {
  std::printf("%s: rotations %.1e, patch test %.1e at worst, up to %zu nodes, %d times mended\n", kind,
              seen.worst.rotation, seen.worst.patch, seen.most_nodes, seen.n_mended);
  EXPECT_GT(seen.n_hanging, 100u);
}

/// The first mesh that mesher and solver take, as searches begin: two cells on a quarter of a fillet are too
/// few where a groove is hardly longer than its fillets, and eight sectors where a thick segment is far off
/// the axis.
meshes::BodyMesh first_mesh(const meshes::Shaft& shaft, bool lean) {
  meshes::ShaftMeshControl control;
  for (const auto& [n_cells, n_sectors] : {std::pair{2, 8}, {4, 8}, {4, 12}, {6, 16}}) try {
      control.cells_per_fillet_quarter = n_cells;
      control.n_sectors = n_sectors;
      control.lean = lean && n_cells == 2;
      auto mesh = meshes::build_shaft(shaft, control);
      fem::make_grid(fem_tests::steel_body(mesh));
      return mesh;
    } catch (const meshes::MeshRefused&) {
    } catch (const fem::MeshUnusable&) {
    }
  return meshes::build_shaft(shaft, {});
}

void examine_shafts(const std::function<meshes::Shaft(std::mt19937&)>& draw, const char* kind) {
  std::mt19937 random(20261123);
  Seen seen;
  for (int i = 0; i < n_refined_bodies(); ++i) {
    const auto shaft = draw(random);
    SCOPED_TRACE(std::to_string(i) + ": " + text(shaft));
    ASSERT_NO_THROW(examine(first_mesh(shaft, i % 2 == 0), random, seen));
  }
  tell(seen, kind);
}

TEST(RefinedBodies, ShaftsStayWhole) {
  examine_shafts(random_shaft, "shafts");
}

TEST(RefinedBodies, DrumsStayWhole) {
  examine_shafts(random_drum, "drums");
}

TEST(RefinedBodies, ChambersStayWhole) {
  std::mt19937 random(20261124);
  Seen seen;
  for (int n_meshed = 0; n_meshed < n_refined_bodies();) {
    const auto chamber = random_chamber(random);
    SCOPED_TRACE(text(chamber));
    meshes::ChamberMeshControl control;
    control.min_scaled_jacobian = 0.01;
    control.cells_through_wall = 1;
    control.size_m = 0.5 * chamber.tube.inner_radius_m;
    control.toe_walls = 2;
    control.lean = n_meshed % 2 == 1;
    meshes::BodyMesh mesh;
    try {
      mesh = meshes::build_chamber(chamber, control);
    } catch (const meshes::GeometryRefused& refused) {  // parts in each other's way: the draw allows it
      continue;
    }
    ++n_meshed;
    ASSERT_NO_THROW(examine(mesh, random, seen));
  }
  tell(seen, "chambers");
}

}  // namespace
