#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/base/values/vtk_order.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/triangulation/body_grid.h"
#include "fem/models/solid/model.h"
#include "fem/stress/recovery/stress_recovery.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

namespace {

using Component = fem::SurfaceResultant::Component;

std::vector<fem::UnitLoad> loads_of_every_kind(const fem_tests::ShaftBody& shaft) {
  std::vector<fem::UnitLoad> loads;
  for (const auto* port : {"bearing_1", "seat", "bearing_2"})
    for (const auto c : {Component::fx, Component::fy, Component::fz, Component::mx, Component::torque})
      loads.push_back(fem_tests::resultant(shaft, port, c));
  loads.push_back(
      {"seat.p2", fem::SeatPressure{shaft.ports.at("seat"), 2, 1, fem::SeatPressure::Phase::sine}});
  loads.push_back({"end_2.torque", fem::SurfaceResultant{shaft.ports.at("end_2"), Component::torque}});
  loads.push_back({"volume.ax", fem::BodyForce{fem::BodyForce::Field::translation_x}});
  loads.push_back({"volume.omega2", fem::BodyForce{fem::BodyForce::Field::spin}});
  return loads;
}

struct Responses : testing::Test {
  static void SetUpTestSuite() {
    shaft = new fem_tests::ShaftBody(fem_tests::eccentric_shaft());
    loads = loads_of_every_kind(*shaft);
    responses = fem::Model(shaft->body).unit_responses(loads, shaft->planes);
  }
  static void TearDownTestSuite() { delete shaft; }
  static fem_tests::ShaftBody* shaft;
  static std::vector<fem::UnitLoad> loads;
  static fem::UnitResponses responses;
};
fem_tests::ShaftBody* Responses::shaft;
std::vector<fem::UnitLoad> Responses::loads;
fem::UnitResponses Responses::responses;

TEST_F(Responses, SupportsCarryRoundOff) {
  EXPECT_LT(responses.support_reaction, 1e-9);
  EXPECT_LT(responses.residual, 1e-10);
  EXPECT_GT(responses.factor_gigabytes, 0);
}

// Betti: the work of load j on response i is that of load i on response j. Responses have no rigid part in
// the mass norm, so the balancing forces do no work on them and the loads as applied may be taken.
TEST_F(Responses, Reciprocity) {
  const auto grid = fem::make_grid(shaft->body);
  const auto integrals = fem::integrate_nodes(grid, fem::colour_cells(grid, fem::cells_of_nodes(grid)));
  const auto force = fem::load_vectors(grid, integrals, 7850, loads);
  const auto n = static_cast<Eigen::Index>(loads.size());
  Eigen::MatrixXd u(force.rows(), n);
  for (Eigen::Index i = 0; i < force.rows(); ++i)
    for (Eigen::Index k = 0; k < n; ++k) u(i, k) = responses.displacement_m[((i / 3) * n + k) * 3 + i % 3];
  const Eigen::MatrixXd work = force.transpose() * u;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      if (loads[i].channel == "volume.ax" || loads[j].channel == "volume.ax")
        continue;  // no response, see below
      EXPECT_NEAR(work(i, j), work(j, i), 1e-9 * std::sqrt(work(i, i) * work(j, j)))
          << loads[i].channel << " " << loads[j].channel;
    }
  const Eigen::MatrixXd motion = fem::rigid_modes(grid, Eigen::Vector3d::Zero()).leftCols<3>().transpose() *
                                 integrals.col(0).replicate(1, 3).reshaped<Eigen::RowMajor>().asDiagonal() *
                                 u;
  EXPECT_LT(motion.cwiseAbs().maxCoeff(), 1e-12 * u.cwiseAbs().maxCoeff() * integrals.col(0).sum());
}

TEST_F(Responses, RigidMotionHasNoStress) {
  const auto grid = fem::make_grid(shaft->body);
  const Eigen::MatrixXd modes = fem::rigid_modes(grid, Eigen::Vector3d::Zero());
  fem::RowMajor u(grid.n_nodes, 18);
  for (Eigen::Index i = 0; i < modes.rows(); ++i)
    for (int k = 0; k < 6; ++k) u(i / 3, 3 * k + i % 3) = modes(i, k);
  const auto elastic = fem::lame(fem_tests::steel);
  const auto stress = fem::stress_at_samples(grid, grid.boundary, elastic, u);
  // A rotation of 1 rad on cells of 1 mm: strain is a difference of numbers of size 1 with rounding 1e-16 /
  // 1e-3.
  EXPECT_LT(stress.cwiseAbs().maxCoeff(), 1e-11 * elastic.mu_Pa);
}

// A uniform acceleration is what balances a load: it strains nothing.
TEST_F(Responses, FreeFallIsStressFree) {
  double largest = 0, spin = 0;
  const std::size_t n = loads.size();
  for (std::size_t i = 0; i < responses.nodes.n; ++i)
    for (int c = 0; c < 6; ++c) {
      largest = std::max(largest, std::abs(responses.stress_Pa[(i * n + n - 2) * 6 + c]));
      spin = std::max(spin, std::abs(responses.stress_Pa[(i * n + n - 1) * 6 + c]));
    }
  EXPECT_GT(spin, 0.1);
  EXPECT_LT(largest, 1e-9 * 7850);
}

// The shaft mirrors in y = 0 but for the load: fy turned into the mirror is -fy.
TEST_F(Responses, MirrorImage) {
  const std::size_t n = loads.size(), fx = 5, fy = 6;  // seat
  ASSERT_EQ(responses.channels[fx], "seat.fx");
  double scale = 0;
  for (std::size_t i = 0; i < responses.nodes.n; ++i)
    scale = std::max(scale, std::abs(responses.stress_Pa[(i * n + fx) * 6 + 2]));
  int found = 0;
  for (std::size_t i = 0; i < responses.nodes.n; ++i) {
    const double* x = &responses.nodes.xyz_m[3 * i];
    if (std::abs(x[1]) > 1e-12) continue;
    ++found;
    const double *sx = &responses.stress_Pa[(i * n + fx) * 6], *sy = &responses.stress_Pa[(i * n + fy) * 6];
    EXPECT_NEAR(sx[3], 0, 1e-8 * scale);
    EXPECT_NEAR(sx[4], 0, 1e-8 * scale);
    for (const int c : {0, 1, 2, 5}) EXPECT_NEAR(sy[c], 0, 1e-8 * scale);
  }
  EXPECT_GT(found, 100);
}

TEST_F(Responses, NodesAreInVtkOrder) {
  const auto& nodes = responses.nodes;
  const auto x = [&](std::int32_t i) { return Eigen::Map<const Eigen::Vector3d>(&nodes.xyz_m[3 * i]); };
  for (std::size_t k = 0; k < nodes.n_cells(); ++k) {
    const auto cell = nodes.cell(k);
    const Eigen::Vector3d a = x(cell[1]) - x(cell[0]), b = x(cell[3]) - x(cell[0]),
                          c = x(cell[4]) - x(cell[0]);
    EXPECT_GT(a.cross(b).dot(c), 0);
    EXPECT_LT((x(cell[8]) - (x(cell[0]) + x(cell[1])) / 2).norm(),
              0.2 * a.norm());  // middle of the first edge
  }
  ASSERT_EQ(nodes.n_faces(), nodes.face_boundary_id.size());
  const auto& end = shaft->ports.at("end_2");
  int n_end = 0;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    if (nodes.face_boundary_id[f] != end.boundary_id) continue;
    ++n_end;
    const auto q = nodes.face(f);
    EXPECT_GT((x(q[1]) - x(q[0])).cross(x(q[3]) - x(q[0]))[2], 0);  // corners counter-clockwise from outside
    for (const auto node : q) EXPECT_NEAR(x(node)[2], end.centre_m[2], 1e-12);
  }
  EXPECT_GT(n_end, 4);
}

TEST_F(Responses, RepeatBitForBit) {
  const auto again = fem::Model(shaft->body).unit_responses(loads, shaft->planes);
  EXPECT_EQ(again.stress_Pa, responses.stress_Pa);
  EXPECT_EQ(again.displacement_m, responses.displacement_m);
  EXPECT_EQ(again.residual, responses.residual);
}

}  // namespace
