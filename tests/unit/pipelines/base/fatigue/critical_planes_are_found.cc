/// Findley against closed forms, and an independent search.
/// Turns red: half the longest chord for the circle, shear counted twice in the tensor, a plane search that
/// stops at a neighbour.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "pipelines/base/fatigue/critical_plane.h"

namespace {

using namespace pipelines;

StressPath history(double sigma, double sigma_mean, double tau, double phase, int n = 72) {
  StressPath h = StressPath::Zero(6, n);
  for (int i = 0; i < n; ++i) {
    h(0, i) = sigma_mean + sigma * std::cos(2 * M_PI * i / n);
    h(3, i) = tau * std::cos(2 * M_PI * i / n - phase);
  }
  return h;
}

StressPath random_history(unsigned seed, int n) {
  std::mt19937 generator(seed);
  std::normal_distribution<> draw;
  return StressPath::NullaryExpr(6, n, [&] { return draw(generator); });
}

TEST(CriticalPlane, SmallestCircle) {
  Eigen::Matrix2Xd triangle(2, 4);
  triangle << 0, 1, 0.5, 0.5, 0, 0, std::sqrt(0.75), 0.3;
  EXPECT_NEAR(smallest_circle_radius(triangle), 1 / std::sqrt(3.0), 1e-14);  // half the chord: 0.5
  Eigen::Matrix2Xd line(2, 3);
  line << 0, 1, 3, 0, 1, 3;
  EXPECT_NEAR(smallest_circle_radius(line), 1.5 * std::sqrt(2.0), 1e-14);
  // All circles of two and three points, the smallest that holds all: brute force.
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Eigen::Matrix2Xd p = random_history(seed, 12).topRows<2>();
    double best = 1e300;
    const auto offer = [&](const Eigen::Vector2d& centre, double radius) {
      if ((p.colwise() - centre).colwise().norm().maxCoeff() <= radius * (1 + 1e-10))
        best = std::min(best, radius);
    };
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < i; ++j) {
        offer((p.col(i) + p.col(j)) / 2, (p.col(i) - p.col(j)).norm() / 2);
        for (int k = 0; k < j; ++k) {
          Eigen::Matrix2d A;
          A << (p.col(j) - p.col(i)).transpose(), (p.col(k) - p.col(i)).transpose();
          const Eigen::Vector2d b(p.col(j).squaredNorm() - p.col(i).squaredNorm(),
                                  p.col(k).squaredNorm() - p.col(i).squaredNorm());
          const Eigen::Vector2d centre = A.inverse() * b / 2;
          offer(centre, (centre - p.col(i)).norm());
        }
      }
    EXPECT_NEAR(smallest_circle_radius(p), best, 1e-9) << seed;
  }
}

// f = (k sigma_max + sqrt(sigma_a^2 + k^2 sigma_max^2)) / 2 from tau_a = sigma_a/2 sin 2t and sigma_n,max =
// sigma_max/2 (1 + cos 2t); reversed: sigma_a/2 (k + sqrt(1 + k^2)).
TEST(CriticalPlane, FindleyOfABar) {
  const CriticalPlaneLimit limit{0.3, 1};
  EXPECT_NEAR(findley(history(2, 0, 0, 0), limit).equivalent_Pa, 0.3 + std::sqrt(1.09), 1e-12);
  EXPECT_NEAR(findley(history(2, 1.5, 0, 0), limit).equivalent_Pa, (0.3 * 3.5 + std::hypot(2, 0.3 * 3.5)) / 2,
              1e-12);
  const auto torsion = findley(history(0, 0, 2, 0), limit);
  EXPECT_NEAR(torsion.equivalent_Pa, 2 * std::sqrt(1.09), 1e-12);
}

// The limits of reversed bending and torsion are both fully used; with tau_W = sigma_W / sqrt(3) that is von
// Mises.
TEST(CriticalPlane, AgreesWithVonMisesWhereFitted) {
  const double sigma_W = 300, tau_W = 300 / std::sqrt(3.0);
  for (const double a : {60.0, 300.0}) {
    EXPECT_NEAR(findley(history(a, 0, 0, 0), findley_limit(sigma_W, tau_W)).utilisation, a / sigma_W, 1e-12);
    EXPECT_NEAR(findley(history(0, 0, a, 0), findley_limit(sigma_W, tau_W)).utilisation,
                a * std::sqrt(3.0) / sigma_W, 1e-12);
  }
  EXPECT_THROW(findley_limit(300, 100), std::invalid_argument);
  EXPECT_THROW(findley_limit(300, 300), std::invalid_argument);
}

// Bending and torsion 90 degrees apart, tau_a = sigma_a / 2: in the plane at angle t the shear is sigma_a / 2
// for every t, the normal stress sigma_a cos t; largest at t = 0: f = sigma_a (1/2 + k).
TEST(CriticalPlane, BendingAndTorsionOutOfPhase) {
  const CriticalPlaneLimit limit{0.3, 1};
  const auto plane = findley(history(2, 0, 1, M_PI / 2), limit);
  EXPECT_NEAR(plane.equivalent_Pa, 1 + 0.3 * 2, 1e-12);
  EXPECT_NEAR(std::abs(plane.normal.x()), 1, 1e-6);
  // Any other ratio: sqrt((s/2 sin 2t)^2 + (q cos 2t)^2) + k sqrt(s^2 cos^4 t + q^2 sin^2 2t), on a fine grid
  // of t.
  for (const double q : {0.3, 1.4, 2.5}) {
    double best = 0;
    for (int i = 0; i < 200000; ++i) {
      const double t = M_PI * i / 200000, c = std::cos(t);
      best = std::max(best, std::hypot(std::sin(2 * t), q * std::cos(2 * t)) +
                                0.3 * std::hypot(2 * c * c, q * std::sin(2 * t)));
    }
    EXPECT_NEAR(findley(history(2, 0, q, M_PI / 2, 3600), limit).equivalent_Pa, best, 1e-6)
        << q;  // between samples a cosine gains (M_PI/3600)^2 / 2
  }
}

// Tractions of a 1-degree grid by the whole tensor, circles by the function above: none is larger.
TEST(CriticalPlane, NoPlaneOfAFineGridIsLarger) {
  const CriticalPlaneLimit limit{0.25, 1};
  for (const unsigned seed : {1u, 2u, 3u}) {
    const StressPath h = random_history(seed, 15);
    double best = 0;
    for (int i = 0; i < 90; ++i)
      for (int j = 0; j < 360; ++j) {
        const double theta = M_PI / 180 * (i + 0.5), phi = M_PI / 180 * j;
        const Eigen::Vector3d n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                std::cos(theta));
        const Eigen::Vector3d u(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                                -std::sin(theta));
        const Eigen::Vector3d v(-std::sin(phi), std::cos(phi), 0);
        Eigen::Matrix2Xd path(2, h.cols());
        double normal = -1e300;
        for (int k = 0; k < h.cols(); ++k) {
          Eigen::Matrix3d s;
          s << h(0, k), h(3, k), h(5, k), h(3, k), h(1, k), h(4, k), h(5, k), h(4, k), h(2, k);
          path.col(k) << u.dot(s * n), v.dot(s * n);
          normal = std::max(normal, n.dot(s * n));
        }
        best = std::max(best, smallest_circle_radius(path) + 0.25 * normal);
      }
    const double found = findley(h, limit).equivalent_Pa;
    EXPECT_GE(found, best);
    EXPECT_NEAR(found, best, 2e-3 * best);  // half a degree off: 2 (0.5 M_PI/180)^2, several times
  }
}

TEST(CriticalPlane, IsFreeOfTheFrame) {
  const StressPath h = random_history(5, 20);
  const Eigen::Matrix3d Q = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
  StressPath turned(6, 20);
  for (int k = 0; k < 20; ++k) {
    Eigen::Matrix3d s;
    s << h(0, k), h(3, k), h(5, k), h(3, k), h(1, k), h(4, k), h(5, k), h(4, k), h(2, k);
    const Eigen::Matrix3d r = Q * s * Q.transpose();
    turned.col(k) << r(0, 0), r(1, 1), r(2, 2), r(0, 1), r(1, 2), r(0, 2);
  }
  const auto a = findley(h, {0.3, 1}), b = findley(turned, {0.3, 1});
  EXPECT_NEAR(a.equivalent_Pa, b.equivalent_Pa,
              1e-7);  // a corner of two circles is found to the last step, 1e-7
  EXPECT_NEAR(std::abs((Q * a.normal).dot(b.normal)), 1, 1e-6);
}

TEST(CriticalPlane, NothingAndRefusals) {
  EXPECT_EQ(findley(StressPath::Zero(6, 4), {0.3, 1}).utilisation, 0);
  EXPECT_THROW(findley(StressPath(6, 0), {0.3, 1}), std::invalid_argument);
  EXPECT_THROW(findley(StressPath::Zero(6, 4), {-0.3, 1}), std::invalid_argument);
}

// A crest between coarse instants: 11 of them, odd, miss it by up to 1 - cos(pi / 22) = 1 %, the finer path
// tells it. Closed form of the reversed bar; turns red if the finer path is left out.
TEST(CriticalPlane, AFinerPathHasTheCrest) {
  const auto limit = findley_limit(300e6, 0.577 * 300e6);
  const double k = limit.normal_share, sigma = 100e6;
  StressPath coarse = StressPath::Zero(6, 11);
  for (int i = 0; i < 11; ++i) coarse(0, i) = sigma * std::cos(2 * M_PI * (i + 0.5) / 11);
  const double expected = sigma / 2 * (k + std::sqrt(1 + k * k));
  EXPECT_NEAR(findley(coarse, history(sigma, 0, 0, 0, 3600), limit).equivalent_Pa, expected, 1e-6 * expected);
  EXPECT_LT(findley(coarse, limit).equivalent_Pa, (1 - 2e-3) * expected);
}

// Long paths are searched by their outermost points: beside the search by all points the value is not larger
// (both are lower bounds of the largest), and smaller by little. Turns red if directions of shear are left
// out.
TEST(CriticalPlane, OutermostPointsTellTheLongPath) {
  const auto limit = findley_limit(300e6, 0.577 * 300e6);
  std::mt19937 generator(7);
  std::normal_distribution<> draw;
  for (int example = 0; example < 6; ++example) {
    StressPath path = StressPath::Zero(6, 2400);
    for (int order : {1, 7, 31}) {
      Eigen::Matrix<double, 6, 2> part;
      for (auto& value : part.reshaped()) value = draw(generator);
      for (int i = 0; i < 2400; ++i) {
        const double t = 2 * M_PI * order * i / 2400;
        path.col(i) += part * Eigen::Vector2d(std::cos(t), std::sin(t));
      }
    }
    const double all = findley(path, limit).equivalent_Pa;
    EXPECT_NEAR(findley(path, path, limit).equivalent_Pa, all, 1e-3 * all) << example;
  }
}

}  // namespace
