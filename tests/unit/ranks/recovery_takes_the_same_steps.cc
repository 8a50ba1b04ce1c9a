// A rank recovers the stress of its nodes on a part of the mesh, and takes the same steps as on the whole.
#include <gtest/gtest.h>

#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/ranks/deal_out_cells.h"
#include "fem/mesh/ranks/ranks.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/stress/recovery/recovery_on_ranks.h"
#include "tests/unit/fem/examples/shaft_bodies.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

/// Sums inside Eigen begin where memory is aligned: a few roundings, which random displacements do not
/// enlarge.
constexpr double alignment = 1e-14;

void expect_same(const fem::Grid& grid, const std::vector<fem::CylinderChart>& charts,
                 const std::vector<int>& loaded) {
  const auto cells = fem::cells_of_nodes(grid);
  const auto elastic = fem::PerCell<fem::Lame>(fem::lame(fem_tests::steel));
  const fem::RowMajor displacement = 1e-6 * fem::RowMajor::Random(grid.n_nodes, 6);
  const auto rank_of_cell = fem::deal_out_cells(grid, fem::n_ranks(MPI_COMM_WORLD));
  const auto shared = fem::share_rows(MPI_COMM_WORLD, grid, rank_of_cell);
  ASSERT_LT(shared->node.size(), grid.n_nodes);
  const fem::RowMajor own = displacement(shared->node, Eigen::all);
  for (const bool by_patches : {true, false}) {
    fem::RowMajor one(grid.n_nodes, 12);
    fem::recover_stress(grid, cells, elastic, charts, loaded, by_patches, displacement, one);
    fem::set_hanging_rows(grid.hanging, one);
    const auto patches = fem::recovery_case(grid, elastic, loaded);
    const auto several = fem::recover_stress_on_ranks(grid, cells, elastic, charts,
                                                      by_patches ? &patches : nullptr, *shared, own);
    ASSERT_GT(one.norm(), 0);
    EXPECT_LT((one(shared->node, Eigen::all) - several).norm(), alignment * one.norm())
        << (by_patches ? "patches" : "averages");
  }
}

TEST(Recovery, OfHexahedraWithCharts) {
  const auto shaft = fem_tests::eccentric_shaft(2);
  expect_same(fem::make_grid(shaft.body), shaft.body.cylinders, {shaft.ports.at("end_1").boundary_id});
}

TEST(Recovery, OfRefinedHexahedra) {
  const auto shaft = fem_tests::eccentric_shaft(2);
  const auto body = fem_tests::refined_at_random(shaft.body, 2, 0.02, 2);
  expect_same(fem::make_grid(body), body.cylinders, {shaft.ports.at("end_1").boundary_id});
}

TEST(Recovery, OfTetrahedra) {
  const auto grid = fem_tests::tetrahedra_block({1, 1, 30}, [](const fem_tests::Point& x) {
    return fem_tests::Point(x[0], x[1] + 0.2 * x[2] * x[2], 30 * x[2]);
  });
  expect_same(grid, {}, {5});
}

}  // namespace
