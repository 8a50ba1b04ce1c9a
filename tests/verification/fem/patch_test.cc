// MacNeal and Harder's patch of seven distorted hexahedra: P15 of the public cases. A state of uniform stress
// is in every displacement space, whatever the shape of the cells, so it comes out to rounding. The stress is
// applied as the tractions of the six sides, on a free body.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

/// The source's fifth inner node, and where it folds no cell.
const Point printed(0.320, 0.186, 0.643), moved(0.320, 0.240, 0.643);

/// The unit cube around an inner hexahedron; sides as those of a block.
verification::HexahedraMesh seven_cells(const Point& fifth) {
  verification::HexahedraMesh mesh;
  mesh.nodes = {{0, 0, 0},          {1, 0, 0},          {1, 1, 0}, {0, 1, 0},          {0, 0, 1},
                {1, 0, 1},          {1, 1, 1},          {0, 1, 1}, {.249, .342, .192}, {.826, .288, .288},
                {.850, .649, .263}, {.273, .750, .230}, fifth,     {.677, .305, .683}, {.788, .693, .644},
                {.165, .745, .702}};
  const auto side = [&](std::array<int, 4> outer, int id) {  // counter-clockwise from outside
    mesh.faces.push_back({outer, id});
    mesh.cells.push_back({outer[0] + 8, outer[1] + 8, outer[2] + 8, outer[3] + 8,  //
                          outer[0], outer[1], outer[2], outer[3]});
  };
  mesh.cells.push_back({8, 9, 10, 11, 12, 13, 14, 15});
  side({0, 4, 7, 3}, verification::begin_1);
  side({1, 2, 6, 5}, verification::end_1);
  side({0, 1, 5, 4}, verification::begin_2);
  side({3, 7, 6, 2}, verification::end_2);
  side({0, 3, 2, 1}, verification::begin_3);
  side({4, 5, 6, 7}, verification::end_3);
  return mesh;
}

/// sigma n on all six sides of the unit cube.
verification::LoadCase tractions(const Eigen::Matrix3d& stress) {
  verification::LoadCase loads;
  for (int side = 0; side < 6; ++side) {
    const double sign = side % 2 == 0 ? -1 : 1;
    Point centre(0.5, 0.5, 0.5);
    centre[side / 2] += 0.5 * sign;
    int d = 0;
    for (const auto component : {Component::fx, Component::fy, Component::fz})
      loads.push_back({verification::on_face(side + 1, centre, component), sign * stress(d++, side / 2)});
  }
  return loads;
}

void expect_uniform(const std::string& cells, const fem::Body& body) {
  Eigen::Matrix3d stress = Eigen::Matrix3d::Constant(400);
  stress.diagonal().setConstant(2000);
  for (const auto recovery : {fem::Recovery::average, fem::Recovery::patch}) {
    const auto s = verification::solve(body, tractions(stress), recovery);
    for (Eigen::Index i = 0; i < s.place_m.cols(); ++i)
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(s.stress_Pa(c, i), c < 3 ? 2000 : 400, 1e-9 * 2000);
    // The displacement of the source, which leaves the corner (0, 0, 0) in its place; a free body has its own
    // translation, and no rotation.
    const Eigen::Vector3d corner = s.displacement_m.col(s.at({0, 0, 0}));
    Eigen::Matrix3d strain = Eigen::Matrix3d::Constant(0.5e-3);
    strain.diagonal().setConstant(1e-3);
    for (Eigen::Index i = 0; i < s.place_m.cols(); ++i)
      EXPECT_LT((s.displacement_m.col(i) - corner - strain * s.place_m.col(i)).norm(), 1e-9 * 2e-3);
    Eigen::Index worst = 0;
    (s.stress_Pa.row(0).array() - 2000).abs().maxCoeff(&worst);
    const std::string where =
        cells + (recovery == fem::Recovery::patch ? ", patches" : ", average") + ", worst node [Pa]";
    verification::check({"P15", "sigma_xx, " + where, 2000, s.stress_Pa(0, worst)}, s, 1e-9);
    (s.stress_Pa.row(3).array() - 400).abs().maxCoeff(&worst);
    verification::check({"P15", "tau_xy, " + where, 400, s.stress_Pa(3, worst)}, s, 1e-9);
  }
}

// As printed, the front cell has a corner with a negative Jacobian (-0.013 of the cube's volume), though not
// at its Gauss points: fem refuses such cells.
TEST(P15, ThePrintedPatchHasAFoldedCorner) {
  fem::Body body;
  body.mesh = verification::cells_of(seven_cells(printed));
  body.material = {1e6, 0.25, 1};
  EXPECT_THROW(fem::Model model(body), std::runtime_error);
}

TEST(P15, DistortedHexahedra) {
  for (const int degree : {1, 2, 3}) {
    fem::Body body;
    body.mesh = verification::cells_of(seven_cells(moved));
    body.material = {1e6, 0.25, 1};
    body.degree = degree;
    expect_uniform("Q" + std::to_string(degree), body);
  }
}

TEST(P15, CurvedTetrahedra) {
  verification::Block block;
  block.cells = {2, 2, 2};
  block.map = [](const Point& c) -> Point {  // the faces of the cube stay where they are
    const double inside = 8 * c[0] * (1 - c[0]) * c[1] * (1 - c[1]) * c[2] * (1 - c[2]);
    return c + inside * Point(0.9, -0.7, 0.5);
  };
  fem::Body body;
  body.mesh = verification::tetrahedra_of(block);
  body.material = {1e6, 0.25, 1};
  expect_uniform("P2", body);
}

}  // namespace
