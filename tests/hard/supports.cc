// A rod between springs from 1 N/m to 1e12 N/m at its ends: the frequency at which it moves along itself goes
// from that of a rigid mass on springs to that of a rod between walls.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/values/body_nodes.h"
#include "tests/verification/fem/block_mesh.h"
#include "tests/verification/fem/figures.h"

namespace {

using verification::Point;

constexpr double side = 0.04, length = 0.4;
constexpr fem::Material steel{200e9, 0, 8000};

/// The rod moves along itself only: its sides slide, springs act along z. Clamps and springs exclude each
/// other in fem, so the sides are free and the mode is found by its shape.
double frequency_Hz(double stiffness_N_m) {
  verification::Block block;
  block.cells = {1, 1, 8};
  block.map = [](const Point& c) { return Point(side * (c[0] - 0.5), side * (c[1] - 0.5), length * c[2]); };
  fem::Body body;
  body.mesh = verification::write_hexahedra(block);
  body.material = steel;
  for (const auto& [face, z] : {std::pair{verification::begin_3, 0.0}, {verification::end_3, length}})
    body.elastic_supports.push_back(
        {verification::on_face(face, {0, 0, z}, fem::SurfaceResultant::Component::fz).surface,
         {0, 0, stiffness_N_m}});
  const auto nodes = fem::body_nodes(body);
  double best = 0, frequency = 0;
  for (const auto& mode : fem::Model(body).natural_frequencies(16)) {
    double along = 0, all = 0;  // sums over nodes
    for (std::size_t i = 0; i < nodes.n; ++i) {
      along += mode.shape[3 * i + 2];
      for (int d = 0; d < 3; ++d) all += mode.shape[3 * i + d] * mode.shape[3 * i + d];
    }
    const double share = along * along / all / double(nodes.n);
    if (share > best) best = share, frequency = mode.frequency_Hz;
  }
  return frequency;
}

/// Even mode cos(k (z - L/2)) with k = w / c:  E A k tan(k L / 2) = stiffness, k L / 2 below pi / 2.
double exact_Hz(double stiffness_N_m) {
  const double e = steel.youngs_modulus_Pa, c = std::sqrt(e / steel.density_kg_m3);
  double low = 0, high = verification::pi / 2;
  for (int i = 0; i < 200; ++i) {
    const double x = (low + high) / 2;
    (e * side * side * 2 * x / length * std::tan(x) < stiffness_N_m ? low : high) = x;
  }
  return low * 2 / length * c / (2 * verification::pi);
}

TEST(Springs, FromSoftToRigidTheFrequencyIsThatOfTheClosedForm) {
  double before = 0;
  for (int decade = 0; decade <= 12; decade += 2) {
    const double k = std::pow(10, decade), ours = frequency_Hz(k), theirs = exact_Hz(k);
    // Eight quadratic cells for half a wave: 1e-5, from above; softer springs bend the rod less.
    EXPECT_NEAR(ours, theirs, 1e-4 * theirs) << k;
    EXPECT_GT(ours, theirs * (1 - 1e-7)) << k;
    EXPECT_GT(ours, before) << "stiffer springs, higher frequency";
    before = ours;
  }
  const double mass = steel.density_kg_m3 * side * side * length;
  EXPECT_NEAR(frequency_Hz(1), std::sqrt(2 / mass) / (2 * verification::pi), 1e-5 * std::sqrt(2 / mass));
  EXPECT_NEAR(before, std::sqrt(steel.youngs_modulus_Pa / steel.density_kg_m3) / (2 * length), 2e-3 * before);
}

}  // namespace
