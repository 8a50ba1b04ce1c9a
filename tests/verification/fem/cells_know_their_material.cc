// Tubes of two materials, one behind the other: what is made from single cells and from rings of nodes takes
// each cell's own material. Closed forms of tension and torsion.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/stress/cell_stress_at_node.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::Point;

constexpr int soft_volume = 7, hard_volume = 8;
constexpr double inner = 0.03, outer = 0.05, middle = 0.04, length = 0.12, jump = 1e3;

// Poisson's ratio 0: sections stay as they are.
fem::Body tube() {
  verification::Block block;
  block.cells = {2, 12, 6};
  block.is_ring = true;
  block.map = [](const Point& c) {
    const double r = inner + (outer - inner) * c[0], angle = 2 * verification::pi * c[1];
    return Point(r * std::cos(angle), r * std::sin(angle), length * c[2]);
  };
  block.volume = [](const std::array<int, 3>& c) { return c[2] < 2 ? soft_volume : hard_volume; };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  for (const int volume : {soft_volume, hard_volume}) {
    fem::CylinderChart chart;
    chart.volume_id = volume;
    body.cylinders.push_back(chart);
  }
  body.material = {1e6, 0, 1000};
  body.material_of_volume = {{hard_volume, {1e6 * jump, 0, 3000}}};
  return body;
}

/// A unit load on each end.
fem::UnitResponses on_ends(const fem::Body& body, Component component) {
  return fem::Model(body).unit_responses(
      {{"begin", verification::on_face(verification::begin_3, {0, 0, 0}, component)},
       {"end", verification::on_face(verification::end_3, {0, 0, length}, component)}},
      {});
}

/// By rounding times the jump.
constexpr double exact_in_the_space = 1e-6;

TEST(CellsKnowTheirMaterial, StressAtANode) {
  const auto body = tube();
  const auto r = on_ends(body, Component::fz);
  double area = 0;  // of the mesh: twelve parabolas for each circle
  for (const double volume : r.nodes.volume_m3) area += volume / length;
  std::size_t n_at_interface = 0;
  for (std::size_t node = 0; node < r.nodes.n; node += 7) {
    n_at_interface += std::abs(r.nodes.xyz_m[3 * node + 2] - middle) < 1e-9;
    for (const auto& cell : fem::cell_stress_at_node_Pa(r, body.material, node, body.material_of_volume))
      EXPECT_NEAR((cell[1][2] - cell[0][2]) * area, 1, exact_in_the_space) << node;
  }
  EXPECT_GT(n_at_interface, 4u);
}

TEST(CellsKnowTheirMaterial, OrAreRefused) {
  const auto body = tube();
  auto r = on_ends(body, Component::fz);
  r.nodes.cell_volume_id.clear();
  EXPECT_THROW(fem::cell_stress_at_node_Pa(r, body.material, 0, body.material_of_volume),
               std::invalid_argument);
  EXPECT_NO_THROW(fem::cell_stress_at_node_Pa(r, body.material, 0));
}

// Torque's shear is one on both sides, T r / J; a ring of surface nodes belongs to one material nevertheless.
TEST(CellsKnowTheirMaterial, RingsAreOfOneMaterial) {
  const auto r = on_ends(tube(), Component::torque);
  const double second = verification::pi / 2 * (std::pow(outer, 4) - std::pow(inner, 4));
  int n_at_interface = 0;
  for (std::size_t i = 0; i < r.rings.size(); ++i) {
    n_at_interface += std::abs(r.rings[i].z_m - middle) < 1e-9;
    const double shear = r.ring_shear_Pa[2 * i + 1][1] - r.ring_shear_Pa[2 * i][1];
    // Twelve parabolas for the circle.
    EXPECT_NEAR(shear * second / r.rings[i].radius_m, 1, 2e-3) << r.rings[i].z_m;
  }
  EXPECT_EQ(n_at_interface, 4) << "inside and outside, soft and hard";
}

}  // namespace
