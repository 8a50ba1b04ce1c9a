#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "meshes/shaft/shaft.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"

namespace {

struct ChartPoint {
  double r = 0, angle = 0, z = 0;
};

/// Inverse of the chart: |p - e (r - r_a)| = r with e = shift / (R - r_a) is quadratic in r; solved in a
/// frame turned so that the shift lies along x.
ChartPoint chart_point(const meshes::CylinderChart& chart, const std::array<double, 3>& p) {
  const double shift = std::hypot(chart.shift_x_m, chart.shift_y_m);
  const double c = shift > 0 ? chart.shift_x_m / shift : 1, s = shift > 0 ? chart.shift_y_m / shift : 0;
  double x = c * p[0] + s * p[1];
  const double y = c * p[1] - s * p[0];
  double r = std::hypot(x, y);
  if (shift != 0 && r > chart.inner_radius_m * (1 + 1e-12)) {
    const double g = shift / (chart.outer_radius_m - chart.inner_radius_m);
    const double a = x + g * chart.inner_radius_m;
    const double outer = (std::sqrt(g * g * a * a + (1 - g * g) * (a * a + y * y)) - g * a) / (1 - g * g);
    if (outer > chart.inner_radius_m) {
      r = outer;
      x -= g * (r - chart.inner_radius_m);
    }
  }
  return {r, std::atan2(y, x), p[2]};
}

/// What fem relies on: in the chart each ring cell is a quadrilateral of the meridian times an interval of
/// angle, and no cell reaches across the radius where the shift begins.
void expect_product_cells(const meshes::Shaft& shaft, int n_sectors, const std::string& name) {
  SCOPED_TRACE(name);
  meshes::ShaftMeshControl control;
  control.n_sectors = n_sectors;
  const auto body = meshes::build_shaft(shaft, control);
  const MeshFile mesh = read_mesh_file(body);
  std::map<int, meshes::CylinderChart> charts;
  for (const auto& chart : body.cylinders) charts[chart.volume_id] = chart;
  ASSERT_EQ(charts.size(), shaft.segments.size());

  const double pi = std::acos(-1.0);
  const double size = shaft.segments.back().end_m - shaft.segments.front().begin_m;
  const double tiny = 1e-11 * size;  // 16 digits in the file, amplified tenfold by the root above
  for (const auto& hex : mesh.hexes) {
    if (mesh.volume_names.at(hex.group) == "core") continue;
    const auto& chart = charts.at(hex.group);
    double smallest = 1e300, largest = 0;
    for (int i = 0; i < 4; ++i) {
      const ChartPoint a = chart_point(chart, mesh.points[hex.nodes[i]]);
      const ChartPoint b = chart_point(chart, mesh.points[hex.nodes[i + 4]]);
      ASSERT_NEAR(a.r, b.r, tiny);
      ASSERT_NEAR(a.z, b.z, tiny);
      const double turn = std::remainder(b.angle - a.angle, 2 * pi);
      ASSERT_NEAR(turn, 2 * pi / n_sectors, 1e-9);  // tiny over the smallest radius
      smallest = std::min(smallest, a.r);
      largest = std::max(largest, a.r);
    }
    if (chart.shift_x_m != 0 || chart.shift_y_m != 0) {
      ASSERT_TRUE(largest < chart.inner_radius_m + tiny || smallest > chart.inner_radius_m - tiny)
          << "a cell from " << smallest << " to " << largest << " across " << chart.inner_radius_m;
    }
  }
}

TEST(Charts, MakeEachRingCellAProductOfMeridianAndAngle) {
  expect_product_cells(laboratory_shaft(), 16, "product_laboratory");
  expect_product_cells(laboratory_shaft(), 12, "product_laboratory_12");
  expect_product_cells(sharp_eccentric_shaft(), 16, "product_sharp_eccentric");
  expect_product_cells(shoulder_shaft(2, 0.1), 16, "product_shoulder");
  expect_product_cells(two_eccentrics(), 16, "product_two_eccentrics");
  expect_product_cells(planetary_drum(), 24, "product_drum");
}

TEST(Charts, BeginTheShiftAtTheTopOfTheFillet) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  for (std::size_t i = 0; i < body.cylinders.size(); ++i) {
    const bool seat = i == 4;
    EXPECT_EQ(body.cylinders[i].shift_x_m, seat ? 0.004 : 0);
    EXPECT_EQ(body.cylinders[i].shift_y_m, 0);
  }
  EXPECT_NEAR(body.cylinders[4].inner_radius_m, 0.021 + 0.0025, 1e-15);
  EXPECT_EQ(body.cylinders[4].outer_radius_m, 0.03);
}

TEST(Charts, LeaveTheCoreStraightAndInsideTheSmallestRadius) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  const MeshFile mesh = read_mesh_file(body);
  for (const auto& hex : mesh.hexes) {
    if (mesh.volume_names.at(hex.group) != "core") continue;
    for (const int node : hex.nodes) ASSERT_LT(std::hypot(mesh.x(node), mesh.y(node)), 0.0125);
  }
}

/// Fem uses the ids of volumes and of boundaries as ids of charts: none may be used twice.
TEST(Charts, HaveIdsThatNoOtherGroupUses) {
  const auto body = meshes::build_shaft(laboratory_shaft(), {});
  const MeshFile mesh = read_mesh_file(body);
  std::set<int> ids;
  for (const auto& group : mesh.volume_names) EXPECT_TRUE(ids.insert(group.first).second);
  for (const auto& group : mesh.boundary_names) EXPECT_TRUE(ids.insert(group.first).second);
  EXPECT_EQ(ids.count(0), 0u);
}

}  // namespace
