// Nodes, cells and faces of hexahedra of degree 1 to 3, and the stress that single cells have at their nodes.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "fem/base/values/body_nodes.h"
#include "fem/models/solid/model.h"
#include "fem/stress/cells/cell_stress_at_node.h"
#include "fem/stress/cells/surface_stress.h"
#include "tests/unit/fem/examples/shaft_bodies.h"

using fem_tests::steel;

struct EveryDegree : testing::TestWithParam<int> {
  static const fem_tests::ShaftBody& shaft() {
    static const auto built = fem_tests::eccentric_shaft(2);
    return built;
  }
  static fem::Body body() {
    auto result = shaft().body;
    result.degree = GetParam();
    return result;
  }
  fem::Nodes nodes = fem::body_nodes(body());
  Eigen::Vector3d at(std::int32_t node) const {
    return Eigen::Map<const Eigen::Vector3d>(&nodes.xyz_m[3 * node]);
  }

  /// Displacement of one channel, as a function of the place.
  template <typename Field>
  fem::UnitResponses displaced(const Field& u) const {
    fem::UnitResponses r;
    r.channels = {"given"};
    r.nodes = nodes;
    for (std::int32_t i = 0; i < std::int32_t(nodes.n); ++i) {
      const Eigen::Vector3d v = u(at(i));
      r.displacement_m.insert(r.displacement_m.end(), v.data(), v.data() + 3);
    }
    return r;
  }
};

namespace {

/// Hooke's law for the displacement gradient, VTK's order.
std::array<double, 6> stress_of(const Eigen::Matrix3d& gradient) {
  const double e = steel.youngs_modulus_Pa, nu = steel.poisson_ratio;
  const double lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / (2 * (1 + nu));
  const Eigen::Matrix3d s =
      lambda * gradient.trace() * Eigen::Matrix3d::Identity() + mu * (gradient + gradient.transpose());
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

}  // namespace

TEST_P(EveryDegree, CountsAreThoseOfTheDegree) {
  const auto n = std::size_t(GetParam()) + 1;
  EXPECT_EQ(nodes.degree, GetParam());
  EXPECT_EQ(nodes.nodes_per_cell(), n * n * n);
  EXPECT_EQ(nodes.nodes_per_face(), n * n);
  auto quadratic = shaft().body;
  const auto other = fem::body_nodes(quadratic);
  EXPECT_EQ(nodes.n_cells(), other.n_cells());
  ASSERT_EQ(nodes.n_faces(), other.n_faces());
  EXPECT_EQ(nodes.face_boundary_id, other.face_boundary_id);
}

// Corners of a cell are right-handed; nodes between two corners lie on the line between them where the cell
// is straight, at Gauss-Lobatto points.
TEST_P(EveryDegree, CellsAreInVtkOrder) {
  const int degree = GetParam();
  for (std::size_t k = 0; k < nodes.n_cells(); ++k) {
    const auto cell = nodes.cell(k);
    const Eigen::Vector3d a = at(cell[1]) - at(cell[0]), b = at(cell[3]) - at(cell[0]),
                          c = at(cell[4]) - at(cell[0]);
    ASSERT_GT(a.cross(b).dot(c), 0);
    if (degree == 1) continue;
    const double first = degree == 2 ? 0.5 : 0.5 - 0.5 / std::sqrt(5.0);
    const Eigen::Vector3d expected = at(cell[0]) + first * a;
    // An arc of 45 degrees bulges by a tenth of its chord.
    ASSERT_LT((at(cell[8]) - expected).norm(), 0.12 * a.norm());
    if (degree == 3) {
      ASSERT_LT((at(cell[9]) - at(cell[1]) + first * a).norm(), 0.12 * a.norm());
    }
  }
}

// Faces are wound counter-clockwise seen from outside: their area vectors close, and with the places of their
// middles make three times the volume (Gauss).
TEST_P(EveryDegree, FacesCloseAroundTheBody) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double volume = 0, area = 0;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    const Eigen::Vector3d p = at(face[0]), q = at(face[1]), r = at(face[2]), s = at(face[3]);
    const Eigen::Vector3d vector = 0.5 * (r - p).cross(s - q);
    sum += vector;
    area += vector.norm();
    volume += vector.dot((p + q + r + s) / 4) / 3;
    std::set<std::int32_t> distinct(face.begin(), face.end());
    ASSERT_EQ(distinct.size(), nodes.nodes_per_face());
    // All of its nodes lie near its corners' plane: an arc of 45 degrees rises by a tenth of its chord.
    for (const auto node : face)
      ASSERT_LT(std::abs((at(node) - p).dot(vector.normalized())), 0.25 * (r - p).norm());
  }
  EXPECT_LT(sum.norm(), 1e-12 * area);  // rounding
  const double whole = fem::Model(body()).mass_properties().volume_m3;
  // Flat faces miss the volume under 8 arcs around: 1 - sin(45 deg) / (pi / 4) = 10 %; bilinear cells are
  // these flats.
  EXPECT_NEAR(volume, whole, (GetParam() == 1 ? 2e-3 : 0.1) * whole);
}

// Isoparametric cells have linear fields exactly, curved or not.
TEST_P(EveryDegree, CellsKnowTheStressOfALinearField) {
  Eigen::Matrix3d gradient;
  gradient << 1e-3, 2e-4, -3e-4, 5e-4, -2e-3, 7e-4, 1e-4, -6e-4, 4e-4;
  const auto r = displaced([&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return gradient * x; });
  const auto expected = stress_of(gradient);
  for (std::size_t node = 0; node < nodes.n; node += nodes.n / 50)
    for (const auto& of_cell : fem::cell_stress_at_node_Pa(r, steel, node))
      for (std::size_t c = 0; c < 6; ++c)
        ASSERT_NEAR(of_cell[0][c], expected[c], 1e-9 * steel.youngs_modulus_Pa);
}

// From degree 2 on, straight cells (the core of the shaft) have quadratic fields exactly: that needs the true
// places of the nodes along an edge.
TEST_P(EveryDegree, StraightCellsKnowTheStressOfAQuadraticField) {
  if (GetParam() == 1) return;
  const auto u = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {x[0] * x[1], x[2] * x[2] - x[0] * x[0], x[1] * x[2]};
  };
  const auto r = displaced(u);
  int n_checked = 0;
  for (std::size_t node = 0; node < nodes.n; ++node) {
    const Eigen::Vector3d x = at(std::int32_t(node));
    if (std::hypot(x[0], x[1]) > 1e-3 || n_checked > 40) continue;  // deep in the core
    ++n_checked;
    Eigen::Matrix3d gradient;
    gradient << x[1], x[0], 0, -2 * x[0], 0, 2 * x[2], 0, x[2], x[1];
    const auto expected = stress_of(gradient);
    for (const auto& of_cell : fem::cell_stress_at_node_Pa(r, steel, node))
      for (std::size_t c = 0; c < 6; ++c)  // rounding; gradients are of the size of the shaft, 0.1
        ASSERT_NEAR(of_cell[0][c], expected[c], 1e-11 * steel.youngs_modulus_Pa) << x.transpose();
  }
  EXPECT_GT(n_checked, 10);
}

// A recovered stress that is none: cells differ from it by all of theirs, at the nodes that are asked for.
TEST_P(EveryDegree, CellsDifferFromTheRecoveredStress) {
  auto r = displaced([](const Eigen::Vector3d& x) -> Eigen::Vector3d { return {1e-3 * x[1] * x[0], 0, 0}; });
  r.stress_Pa.assign(6 * nodes.n, 0.0);
  const double factor = -2;
  std::vector<const double*> factors(nodes.n, nullptr);
  for (std::size_t node = 0; node < nodes.n; node += 7) factors[node] = &factor;
  const auto differences = fem::largest_cell_differences_Pa(r, steel, factors);
  for (std::size_t node = 0; node < nodes.n; node += nodes.n / 50) {
    double largest = 0;
    for (const auto& of_cell : fem::cell_stress_at_node_Pa(r, steel, node)) {
      const auto& s = of_cell[0];
      largest = std::max(largest, std::sqrt(((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) +
                                             (s[2] - s[0]) * (s[2] - s[0])) /
                                                2 +
                                            3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])));
    }
    EXPECT_NEAR(differences[node], node % 7 == 0 ? 2 * largest : 0, 1e-9 * steel.youngs_modulus_Pa * 1e-3);
  }
}

// Stress that is the place itself: what is found between the nodes are the points of the faces. Around the
// axis, on the end face, faces are straight: their points are bilinear in the corners.
TEST_P(EveryDegree, StressBetweenNodesIsThatOfTheFaces) {
  constexpr int n = 4;
  fem::UnitResponses r;
  r.channels = {"place", "twice"};
  r.nodes = nodes;
  std::size_t centre = 0;
  for (std::size_t i = 0; i < nodes.n; ++i) {
    const Eigen::Vector3d x = at(std::int32_t(i));
    for (const double factor : {1, 2})
      r.stress_Pa.insert(r.stress_Pa.end(), {factor * x[0], factor * x[1], factor * x[2], 0, 0, factor});
    const Eigen::Vector3d least = at(std::int32_t(centre));
    const double nearer = x[2] - least[2] + 0.1 * (std::hypot(x[0], x[1]) - std::hypot(least[0], least[1]));
    if (nearer < 0) centre = i;
  }
  const std::vector<char> none(nodes.n, 0);
  const auto found = fem::stress_on_faces_around_Pa(r, centre, n, none);
  std::size_t k = 0;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
    const auto face = nodes.face(f);
    if (std::find(face.begin(), face.end(), std::int32_t(centre)) == face.end()) continue;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i, ++k) {
        ASSERT_LT(k, found.size());
        const double u = double(i) / n, v = double(j) / n;
        const Eigen::Vector3d expected = (1 - u) * (1 - v) * at(face[0]) + u * (1 - v) * at(face[1]) +
                                         u * v * at(face[2]) + (1 - u) * v * at(face[3]);
        for (int d = 0; d < 3; ++d) {
          ASSERT_NEAR(found[k][0][std::size_t(d)], expected[d], 1e-15);  // rounding of millimetres
          ASSERT_NEAR(found[k][1][std::size_t(d)], 2 * expected[d], 1e-15);
        }
        ASSERT_NEAR(found[k][1][5], 2, 1e-14) << "shape functions add up to 1";
      }
  }
  EXPECT_EQ(k, found.size());
  EXPECT_EQ(k, 4u * (n + 1) * (n + 1)) << "four faces meet at the axis";

  auto some = none;
  const auto faces = nodes.n_faces();
  for (std::size_t f = 0; f < faces; ++f) {
    const auto face = nodes.face(f);
    if (std::find(face.begin(), face.end(), std::int32_t(centre)) == face.end()) continue;
    some[std::size_t(*std::find_if(face.begin(), face.begin() + 4, [&](auto i) {
      return (at(i) - at(std::int32_t(centre))).norm() > 1e-6;
    }))] = 1;
    break;
  }
  const auto fewer = fem::stress_on_faces_around_Pa(r, centre, n, some).size();
  EXPECT_LT(fewer, found.size()) << "faces with a node that is left out";
  EXPECT_GT(fewer, 0u);
}

// A point between a face's nodes is the sum of their places; where a node lies there is no other.
TEST_P(EveryDegree, PointsOfTheSurfaceHaveTheirFacesNodes) {
  for (std::size_t f = 0; f < nodes.n_faces(); f += 7) {
    const auto face = nodes.face(f);
    const Eigen::Vector3d node = at(face[0]), beside = at(face[1]), opposite = at(face[2]);
    const auto here = fem::point_on_boundary(nodes, {node[0], node[1], node[2]}, 1e-9).shares;
    ASSERT_EQ(here.size(), 1u);
    EXPECT_EQ(here[0].node, std::size_t(face[0]));
    EXPECT_EQ(here[0].weight, 1);
    // Off the chords by up to what the arc rises, which is what may be asked for.
    const Eigen::Vector3d between = 0.5 * node + 0.2 * beside + 0.3 * opposite;
    const double rise_m = 0.2 * (opposite - node).norm();
    const auto shares = fem::point_on_boundary(nodes, {between[0], between[1], between[2]}, rise_m).shares;
    ASSERT_GT(shares.size(), 1u);
    double sum = 0;
    Eigen::Vector3d found = Eigen::Vector3d::Zero();
    for (const auto& share : shares)
      sum += share.weight, found += share.weight * at(std::int32_t(share.node));
    EXPECT_NEAR(sum, 1, 1e-8);  // weights below 1e-9 are left out
    EXPECT_LT((found - between).norm(), rise_m);
    const auto holding = nodes.face(fem::point_on_boundary(nodes, {found[0], found[1], found[2]}, 1e-9).face);
    for (const auto& share : shares)
      EXPECT_NE(std::find(holding.begin(), holding.end(), std::int32_t(share.node)), holding.end());
    const auto again = fem::point_on_boundary(nodes, {found[0], found[1], found[2]}, 1e-9).shares;
    Eigen::Vector3d same = Eigen::Vector3d::Zero();
    for (const auto& share : again) same += share.weight * at(std::int32_t(share.node));
    EXPECT_LT((same - found).norm(), 1e-9) << "what lies on the surface is found there";
  }
  const Eigen::Vector3d node = at(nodes.face(0)[0]);
  EXPECT_TRUE(fem::point_on_boundary(nodes, {node[0], node[1], node[2] + 1}, 1e-3).shares.empty());
}

INSTANTIATE_TEST_SUITE_P(Q, EveryDegree, testing::Values(1, 2, 3));
