// A rod between springs from 1 N/m to 1e12 N/m at its ends: the frequency at which it moves along itself goes
// from that of a rigid mass on springs to that of a rod between walls.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <sstream>

#include "fem/base/values/body_nodes.h"
#include "tests/hard/hard_case.h"
#include "tests/verification/fem/bodies/block_mesh.h"
#include "tests/verification/fem/bodies/figures.h"

namespace {

using verification::Point;

constexpr double side = 0.04, length = 0.4;
constexpr fem::Material steel{200e9, 0, 8000};

fem::Body sprung_rod(double stiffness_N_m) {
  verification::Block block;
  block.cells = {1, 1, 8};
  block.map = [](const Point& c) { return Point(side * (c[0] - 0.5), side * (c[1] - 0.5), length * c[2]); };
  fem::Body body;
  body.mesh = verification::hexahedra_of(block);
  body.material = steel;
  for (const auto& [face, z] : {std::pair{verification::begin_3, 0.0}, {verification::end_3, length}})
    body.elastic_supports.push_back(
        {verification::on_face(face, {0, 0, z}, fem::SurfaceResultant::Component::fz).surface,
         {0, 0, stiffness_N_m}});
  return body;
}

/// The rod moves along itself only: its sides slide, springs act along z. Clamps and springs exclude each
/// other in fem, so the sides are free and the mode is found by its shape.
double frequency_Hz(double stiffness_N_m) {
  const auto body = sprung_rod(stiffness_N_m);
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

/// Sixty-four linear elements of the rod and its two springs in one matrix.
struct NaiveRod {
  static constexpr int n = 64;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + 1, n + 1), M = K;

  explicit NaiveRod(double stiffness_N_m) {
    const double k = steel.youngs_modulus_Pa * side * side * n / length,
                 m = steel.density_kg_m3 * side * side * length / n / 6;
    for (int i = 0; i < n; ++i) {
      K.block<2, 2>(i, i) += (Eigen::Matrix2d() << k, -k, -k, k).finished();
      M.block<2, 2>(i, i) += (Eigen::Matrix2d() << 2 * m, m, m, 2 * m).finished();
    }
    K(0, 0) += stiffness_N_m, K(n, n) += stiffness_N_m;
  }
  double lowest_Hz() const {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M, Eigen::EigenvaluesOnly);
    return std::sqrt(modes.eigenvalues()[0]) / (2 * verification::pi);
  }
  /// Tension in the middle under a pull of 1 at both ends, by the inverse.
  double tension_N() const {
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(n + 1);
    pull[0] = -1, pull[n] = 1;
    const Eigen::VectorXd u = K.inverse() * pull;
    return (u[n / 2 + 1] - u[n / 2]) * steel.youngs_modulus_Pa * side * side * n / length;
  }
};

/// Between springs that take k u of the pull at each end: 1 / (1 + k L / (2 E A)). The springs act on the
/// elastic displacement, which a pull of both ends has alone.
double tension_N(double stiffness_N_m) {
  const auto on = [](int face, double z, double force) {
    return std::pair{decltype(fem::UnitLoad::shape)(
                         verification::on_face(face, {0, 0, z}, fem::SurfaceResultant::Component::fz)),
                     force};
  };
  const auto s = verification::solve(sprung_rod(stiffness_N_m),
                                     {on(verification::begin_3, 0, -1), on(verification::end_3, length, 1)});
  return s.stress_Pa(2, s.at({0, 0, length / 2})) * side * side;
}

}  // namespace

// Eight quadratic cells for half a wave: 1e-5; statics is in the space, rounding of the body's stiffness
// 1e-9.
TEST(HardSupports, SpringsFrom1To1e12) {
  for (const double k : {1.0, 1e6, 1e12}) {
    std::ostringstream size;
    size << k << " N/m";
    const double exact = 1 / (1 + k * length / (2 * steel.youngs_modulus_Pa * side * side));
    const double naive = k == 1 ? NaiveRod(k).tension_N() : k > 1e9 ? 0 : 1;
    hard_cases::check({"supports", "tension between springs of " + size.str(),
                       k == 1 ? "of motions of 0.5 m the elastic part is 1e-9" : "neither free nor held",
                       k == 1    ? "flexibility: the inverse of rod and springs"
                       : k > 1e9 ? "walls instead of springs"
                                 : "no springs",
                       hard_cases::relative(naive, exact), hard_cases::relative(tension_N(k), exact), 1e-9});
  }
  hard_cases::check({"supports", "frequency on springs of 1 N/m", "squares of frequencies differ by 1e13",
                     "eigenvalues of 64 linear elements",
                     hard_cases::relative(NaiveRod(1).lowest_Hz(), exact_Hz(1)),
                     hard_cases::relative(frequency_Hz(1), exact_Hz(1)), 1e-5});
  hard_cases::check({"supports", "frequency on springs of 1e12 N/m", "all but a wall",
                     "a rigid mass on springs",
                     hard_cases::relative(std::sqrt(2e12 / (steel.density_kg_m3 * side * side * length)) /
                                              (2 * verification::pi),
                                          exact_Hz(1e12)),
                     hard_cases::relative(frequency_Hz(1e12), exact_Hz(1e12)), 1e-4});
}

TEST(HardSupports, FromSoftToRigidTheFrequencyIsThatOfTheClosedForm) {
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
