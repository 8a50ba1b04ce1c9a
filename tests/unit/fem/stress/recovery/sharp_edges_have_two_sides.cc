/// Recovered stress beside a sharp edge that turns into the material, on the displacement of Williams (J.
/// Appl. Mech. 19, 1952): r^0.5445 around a corner of 270 degrees of material with faces free of traction.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>

#include "fem/equations/operators/sharp_edges.h"
#include "fem/equations/operators/subdomain.h"
#include "fem/mesh/grid/cell_geometry.h"
#include "fem/mesh/grid/connected_pieces.h"
#include "fem/stress/recovery/recovery_on_ranks.h"
#include "tests/unit/fem/examples/tetrahedra.h"

namespace {

using Complex = std::complex<double>;

constexpr double poisson_ratio = 0.3, mu_Pa = 80e9;
constexpr double order = 0.544483736782464;  // sin(3 pi / 2 x) = x
constexpr int notch = 7;                     // boundary group of both faces

/// Kolosov's functions z^order and b z^order about the edge, whose bisector in the material is the real axis.
struct Williams {
  double b = -std::cos(1.5 * M_PI * order);

  /// The notch lies at x, y > 1/2.
  static Complex turned(double x, double y) {
    return -Complex(x - 0.5, y - 0.5) * std::polar(1.0, -M_PI / 4);
  }
  static Complex power(Complex z, double exponent) {
    return std::abs(z) > 0 ? std::pow(z, exponent) : Complex(0);
  }

  /// 2 mu (u + i v) = kappa phi - z conj(phi') - conj(psi), in the axes of the body.
  std::array<double, 2> displacement(double x, double y) const {
    const Complex z = turned(x, y);
    const double kappa = 3 - 4 * poisson_ratio;
    const Complex u = kappa * power(z, order) -
                      (std::abs(z) > 0 ? z * std::conj(order * power(z, order - 1)) : Complex(0)) -
                      std::conj(b * power(z, order));
    const Complex in_body = -u * std::polar(1.0, M_PI / 4) / (2 * mu_Pa);
    return {in_body.real(), in_body.imag()};
  }

  /// On a face, where 4 Re phi' along it is all there is, in plane strain.
  double von_mises_on_face_Pa(double distance) const {
    const double along = 4 * order * std::pow(distance, order - 1) * std::cos((order - 1) * 0.75 * M_PI),
                 out = poisson_ratio * along;
    return std::sqrt(along * along - along * out + out * out);
  }
};

/// How much steeper than r^order its interpolant in cells of degree 2 is at the edge, in the middle of the
/// first cell: (h^order - 0) / h over order (h/2)^(order - 1), 1.339. Whatever a recovery makes of the cell,
/// the slope of what it is given there is a third too steep, so that no bound of less can be asked of it. A
/// straight line through the slopes at the Gauss points of the first two cells has the same share at the
/// first one's end.
double steepness() {
  return std::pow(2, order - 1) / order;
}

/// A block with 2 n x 2 n x 2 boxes without the quarter beyond x, y = 1/2.
fem::Grid notched(int n) {
  const auto block = fem_tests::tetrahedra_block({2 * n, 2 * n, 2}, [](const auto& x) { return x; });
  std::vector<std::int32_t> cells;
  for (std::size_t c = 0; c < block.n_cells(); ++c) {
    double x = 0, y = 0;
    for (int i = 0; i < 4; ++i) {
      x += block.position(block.nodes_of(c)[i])[0] / 4;
      y += block.position(block.nodes_of(c)[i])[1] / 4;
    }
    if (x < 0.5 || y < 0.5) cells.push_back(std::int32_t(c));
  }
  auto grid = fem::make_subdomain(block, cells).grid;
  const auto beyond = fem::cells_beyond_faces(grid);
  std::map<std::pair<std::int32_t, int>, bool> known;
  for (const auto& face : grid.boundary) known[{face.cell, face.face}] = true;
  for (std::size_t k = 0; k < beyond.size(); ++k)
    if (beyond[k] < 0 && known.count({std::int32_t(k / 4), int(k % 4)}) == 0)
      grid.boundary.push_back({std::int32_t(k / 4), int(k % 4), notch});
  return grid;
}

struct Recovered {
  fem::Grid grid;
  std::vector<double> von_mises_Pa;

  /// Of a face's nodes at mid length, by their distance from the edge.
  std::multimap<double, double> on_face(int coordinate) const {
    std::multimap<double, double> values;
    std::map<std::int32_t, bool> taken;
    for (const auto& face : grid.boundary)
      if (face.boundary_id == notch)
        for (const auto node : fem::nodes_of_face(grid, std::size_t(face.cell), face.face)) {
          const double* x = grid.position(node);
          const auto nodes = fem::nodes_of_face(grid, std::size_t(face.cell), face.face);
          bool is_mine = true;  // all corners in the plane
          for (int i = 0; i < 3; ++i)
            is_mine = is_mine && std::abs(grid.position(nodes[std::size_t(i)])[coordinate] - 0.5) < 1e-9;
          if (!is_mine || std::abs(x[2] - 0.5) > 1e-9 || taken[node]) continue;
          taken[node] = true;
          values.emplace(x[1 - coordinate] - 0.5, von_mises_Pa[std::size_t(node)]);
        }
    return values;
  }
};

Recovered recovered(int n, bool is_split) {
  const auto whole = notched(n);
  auto grid = is_split ? fem::split_at_sharp_edges(whole, fem::cells_of_nodes(whole)).grid : whole;
  fem::RowMajor displacement = fem::RowMajor::Zero(Eigen::Index(grid.n_nodes), 3),
                stress(Eigen::Index(grid.n_nodes), 6);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const double* x = grid.position(std::int32_t(i));
    const auto u = Williams().displacement(x[0], x[1]);
    displacement(Eigen::Index(i), 0) = u[0];
    displacement(Eigen::Index(i), 1) = u[1];
  }
  const double lambda_Pa = 2 * mu_Pa * poisson_ratio / (1 - 2 * poisson_ratio);
  fem::recover_stress(grid, fem::cells_of_nodes(grid), fem::Lame{lambda_Pa, mu_Pa}, {}, {1, 2, 3, 4, 5, 6},
                      true, displacement, stress);
  Recovered result{std::move(grid), {}};
  for (Eigen::Index i = 0; i < stress.rows(); ++i)
    result.von_mises_Pa.push_back(fem::von_mises(&stress(i, 0)));
  return result;
}

}  // namespace

// On both faces stress rises up to the edge; beyond the cells at the edge it is that of the closed form, and
// on them as steep as the interpolant of the displacement. With one value for both sides it falls towards the
// edge.
TEST(SharpEdgesHaveTwoSides, StressRisesToTheEdgeOnBothFaces) {
  constexpr int n = 4;
  const auto body = recovered(n, true);
  const auto whole = recovered(n, false);
  for (const int coordinate : {0, 1}) {
    const auto values = body.on_face(coordinate);
    ASSERT_GE(values.size(), 2U * n);
    const double at_edge_Pa = values.begin()->second;
    EXPECT_EQ(values.begin()->first, 0);
    const double cell = 0.5 / n;
    for (const auto& [distance, value_Pa] : values) {
      const double exact_Pa = Williams().von_mises_on_face_Pa(distance);
      if (distance > 0) {
        EXPECT_LT(value_Pa, at_edge_Pa) << distance;
      }
      if (distance > 0.4 * cell && distance < 0.4) {
        EXPECT_NEAR(value_Pa / exact_Pa, 1, distance < 1.1 * cell ? steepness() - 1 : 0.1) << distance;
      }
    }
    const auto of_one_value = whole.on_face(coordinate);
    EXPECT_LT(of_one_value.begin()->second, std::next(values.begin())->second)
        << "one value for both sides: less on the edge than there is in the middle of the first cell";
  }
}

// The rest of the body stays as it is, and bodies without such edges do.
TEST(SharpEdgesHaveTwoSides, OnlyNodesOfTheEdgeAreTwice) {
  const auto grid = notched(2);
  const auto split = fem::split_at_sharp_edges(grid, fem::cells_of_nodes(grid));
  EXPECT_EQ(split.copy.size(), 5U);  // two boxes along the edge
  for (const auto node : split.copy) {
    EXPECT_NEAR(grid.position(node)[0], 0.5, 1e-12);
    EXPECT_NEAR(grid.position(node)[1], 0.5, 1e-12);
  }
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int i = 0; i < grid.nodes_per_cell(); ++i) {
      const auto node = split.grid.nodes_of(c)[i];
      const auto of_grid =
          std::size_t(node) < grid.n_nodes ? node : split.copy[std::size_t(node) - grid.n_nodes];
      EXPECT_EQ(of_grid, grid.nodes_of(c)[i]);
    }
  const auto cube = fem_tests::irregular_cube(2);
  EXPECT_TRUE(fem::split_at_sharp_edges(cube, fem::cells_of_nodes(cube)).copy.empty());
  EXPECT_TRUE(fem::split_at_sharp_edges(grid, fem::cells_of_nodes(grid), notch).copy.empty())
      << "the rim of a submodel is no surface";
}
