// Systematic meshes of a body whose stress is known: an annular disc that turns (Timoshenko and Goodier, art.
// 32).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/study/accuracy/grid_convergence.h"
#include "pipelines/study/accuracy/systematic_meshes.h"
#include "tests/unit/pipelines/examples/shared_environment.h"

namespace {

constexpr double outer_m = 0.2, bore_m = 0.05, rho = 7800, nu = 0.3;

pipelines::BodyScene disc() {
  pipelines::BodyScene body;
  body.name = "disc";
  body.material = {210e9, nu, rho};
  pipelines::ShaftShape shape;
  meshes::ShaftSegment segment;
  segment.name = "disc";
  segment.begin_m = -0.005;
  segment.end_m = 0.005;
  segment.diameter_m = 2 * outer_m;
  segment.bore_m = 2 * bore_m;
  shape.geometry.segments = {segment};
  shape.mesh.n_sectors = 16;
  body.shape = shape;
  return body;
}

/// Mean hoop stress around the bore's edge at a speed of 1000 rad/s.
double at_bore_Pa(const fem::UnitResponses& r) {
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < r.nodes.n; ++i) {
    const double *x = &r.nodes.xyz_m[3 * i], *s = &r.stress_Pa[6 * i], radius = std::hypot(x[0], x[1]);
    if (radius > bore_m * 1.001) continue;
    const double c = x[0] / radius, q = x[1] / radius;
    sum += 1e6 * (s[0] * q * q + s[1] * c * c - 2 * s[3] * c * q);
    ++n;
  }
  return sum / n;
}

}  // namespace

TEST(GridConvergence, OfARotatingDiscBoundsItsError) {
  shared::start_fem();
  const fem::UnitLoad spin{"volume.spin", fem::BodyForce{fem::BodyForce::Field::spin, {}}};
  // rho w^2 / 4 ((3 + nu) b^2 + (1 - nu) a^2): 260.8 MPa. The thickness adds a mean of nothing and less than
  // 0.1 %.
  const double known_Pa = rho * 1e6 / 4 * ((3 + nu) * outer_m * outer_m + (1 - nu) * bore_m * bore_m),
               thickness_Pa = 1e-3 * known_Pa;
  for (const int degree : {1, 2}) {
    std::vector<pipelines::MeshValue> series;
    for (const int level : {2, 3, 4}) {
      auto body = pipelines::systematic_mesh(disc(), level);
      body.degree = degree;
      const auto meshed = pipelines::mesh_body(body, {});
      const auto responses = meshed.model->unit_responses({spin}, {});
      EXPECT_EQ(responses.nodes.degree, degree);
      series.push_back({pipelines::cell_size_m(responses.nodes), at_bore_Pa(responses)});
    }
    const auto c = pipelines::grid_convergence(series, degree);
    const double error_Pa = std::abs(series.back().value - known_Pa);
    ASSERT_TRUE(c.usable()) << degree << ": " << c.refusal << ": " << series[0].value << " "
                            << series[1].value << " " << series[2].value;
    EXPECT_GE(c.observed_order, degree - 0.5) << "stress of cells of degree p converges with order p";
    EXPECT_LE(error_Pa, c.index_21 + thickness_Pa) << degree;
    // Linear cells are barely in the asymptotic range: extrapolation helps, no more.
    const double share = degree == 1 ? 1 : 0.5;
    EXPECT_LE(std::abs(c.extrapolated - known_Pa), share * error_Pa + thickness_Pa) << degree;
    std::printf("  Q%d: %.2f %.2f %.2f MPa, order %.2f, extrapolated %.2f, index %.2f, error %.2f MPa\n",
                degree, series[0].value / 1e6, series[1].value / 1e6, series[2].value / 1e6, c.observed_order,
                c.extrapolated / 1e6, c.index_21 / 1e6, error_Pa / 1e6);
    EXPECT_GT(error_Pa, 2 * thickness_Pa) << "too close to tell anything: " << degree;
  }
}
