/// The chamber's mesh: watertight, boundary nodes on their surfaces, groups that mean what they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "meshes/chamber/chamber.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"
#include "tests/unit/meshes/examples/watertight_body.h"

namespace {

/// Coordinates are written with 16 decimal digits; a few operations on them round at 1e-15 of 0.5 m.
const double rounding_m = 1e-13;

std::map<std::string, std::set<int>> nodes_by_group(const MeshFile& mesh) {
  std::map<std::string, std::set<int>> nodes;
  for (const auto& quad : mesh.quads)
    nodes[mesh.boundary_names.at(quad.group)].insert(quad.nodes.begin(), quad.nodes.end());
  return nodes;
}

TEST(ChamberMesh, IsWatertightWithEveryFreeFaceInExactlyOneGroup) {
  meshes::ChamberMeshControl fine;
  fine.size_m = 0.01;
  fine.cells_through_wall = 3;
  meshes::ChamberMeshControl coarse;
  coarse.size_m = 0.1;
  coarse.growth = 2;
  coarse.cells_through_wall = 1;
  meshes::ChamberMeshControl local;
  local.cells_through_wall = 4;
  local.fine_toes = {{{0.15, 0.05, 0.04}, 0.1}};
  for (const auto& control : {meshes::ChamberMeshControl(), fine, coarse, local})
    for (const auto& chamber : {laboratory_chamber(), lopsided_chamber()})
      expect_watertight(meshes::build_chamber(chamber, control));
}

TEST(ChamberMesh, OfTheLaboratoryIsOfASizeThatIsSolvedInSeconds) {
  const auto body = meshes::build_chamber(laboratory_chamber(), {});
  EXPECT_GT(body.quality.n_cells, 5000u);
  EXPECT_LT(body.quality.n_cells, 9000u);
  EXPECT_GT(body.quality.min_scaled_jacobian, 0.6);
  // 0.5 mm between the webs' faces and the housing's ends, cells of 20 mm.
  EXPECT_GT(body.quality.max_aspect, 20);
  EXPECT_LT(body.quality.max_aspect, 50);
}

void expect_on_surfaces(const meshes::Chamber& chamber) {
  const auto body = meshes::build_chamber(chamber, {});
  const MeshFile mesh = read_mesh_file(body);
  const auto groups = nodes_by_group(mesh);
  ASSERT_EQ(groups.size(), body.features.size());
  const auto& tube = chamber.tube;
  const double outer_m = tube.inner_radius_m + tube.wall_m;

  for (const auto& feature : body.features) {
    SCOPED_TRACE(feature.name);
    ASSERT_EQ(mesh.boundary_names.at(feature.boundary_id), feature.name);
    double first_m = 1e300, last_m = -1e300;
    for (const int node : groups.at(feature.name)) {
      first_m = std::min(first_m, mesh.z(node));
      last_m = std::max(last_m, mesh.z(node));
      const double from_axis_m = std::hypot(mesh.x(node) - tube.axis_x_m, mesh.y(node) - tube.axis_y_m);
      const double from_housing_m = std::hypot(mesh.x(node), mesh.y(node));
      const std::string name = feature.name;
      if (name == "inner_wall") {
        ASSERT_NEAR(from_axis_m, tube.inner_radius_m, rounding_m);
      } else if (name == "tube outside") {
        ASSERT_NEAR(from_axis_m, outer_m, rounding_m);
      } else if (name == "housing_bore") {
        ASSERT_NEAR(from_housing_m, chamber.housing.bore_radius_m, rounding_m);
      } else if (name == "housing outside") {
        ASSERT_NEAR(from_housing_m, chamber.housing.outer_radius_m, rounding_m);
      } else if (name == "covers") {
        ASSERT_NEAR(std::abs(mesh.z(node)), 0.5 * tube.length_m, rounding_m);
        ASSERT_GT(from_axis_m, outer_m - rounding_m);
        ASSERT_LT(from_axis_m, chamber.flanges.outer_radius_m + rounding_m);
      } else if (name.rfind("spring_foot_", 0) == 0) {
        const auto& foot = chamber.feet[std::stoul(name.substr(12)) - 1];
        const double side = foot.y_m > tube.axis_y_m ? 0.5 : -0.5;
        ASSERT_NEAR(mesh.y(node), foot.y_m + side * chamber.pads.size_y_m, rounding_m);
        ASSERT_LT(std::abs(mesh.x(node) - foot.x_m), 0.5 * chamber.pads.size_x_m + rounding_m);
        ASSERT_NEAR(std::abs(mesh.z(node)), chamber.lugs.z_m, 0.5 * chamber.pads.size_z_m + rounding_m);
      }
    }
    EXPECT_NEAR(first_m, feature.begin_m, rounding_m);
    EXPECT_NEAR(last_m, feature.end_m, rounding_m);
  }
}

TEST(ChamberMesh, HasItsBoundaryNodesOnTheirSurfaces) {
  expect_on_surfaces(laboratory_chamber());
  expect_on_surfaces(lopsided_chamber());
}

TEST(ChamberMesh, HasPortsChartsAndRegionsOfTheDrawing) {
  const auto body = meshes::build_chamber(laboratory_chamber(), {});
  const MeshFile mesh = read_mesh_file(body);
  std::map<std::string, meshes::Port> ports;
  for (const auto& port : body.ports) {
    EXPECT_EQ(mesh.boundary_names.at(port.boundary_id), port.name);
    ports[port.name] = port;
  }
  ASSERT_EQ(ports.size(), 5u);
  using Kind = meshes::Port::Kind;
  const auto expect = [&](const std::string& name, Kind kind, double x_m, double y_m, double radius_m,
                          double end_m) {
    const auto& port = ports.at(name);
    EXPECT_EQ(port.kind, kind) << name;
    EXPECT_EQ(port.axis_x_m, x_m) << name;
    EXPECT_EQ(port.axis_y_m, y_m) << name;
    EXPECT_NEAR(port.radius_m, radius_m, rounding_m) << name;
    EXPECT_NEAR(port.end_m, end_m, rounding_m) << name;
    EXPECT_EQ(port.begin_m, -port.end_m) << name;
  };
  expect("housing_bore", Kind::bore, 0, 0, 0.0475, 0.0525);
  expect("inner_wall", Kind::bore, 0.28, 0.04, 0.13, 0.14);
  expect("spring_foot_1", Kind::face, 0.1, -0.18, 0, 0.115);
  expect("spring_foot_2", Kind::face, 0.46, -0.18, 0, 0.115);
  expect("covers", Kind::face, 0.28, 0.04, 0.175, 0.14);

  std::set<int> ids;
  for (const auto& group : mesh.volume_names) EXPECT_TRUE(ids.insert(group.first).second);
  for (const auto& group : mesh.boundary_names) EXPECT_TRUE(ids.insert(group.first).second);
  EXPECT_EQ(ids.count(0), 0u);

  ASSERT_EQ(body.regions.size(), 2u);
  std::set<int> volumes;
  for (const auto& region : body.regions)
    for (const int id : region.volume_ids) EXPECT_TRUE(volumes.insert(id).second);
  EXPECT_EQ(volumes.size(), mesh.volume_names.size());
  EXPECT_EQ(body.regions[1].name, "exciter");
  EXPECT_EQ(mesh.volume_names.at(body.regions[1].volume_ids.at(0)), "housing");
}

/// What fem relies on: in the chart of its group each cell is an interval of radius times one of angle.
void expect_product_cells(const meshes::Chamber& chamber) {
  const auto body = meshes::build_chamber(chamber, {});
  const MeshFile mesh = read_mesh_file(body);
  std::map<int, meshes::CylinderChart> charts;
  for (const auto& chart : body.cylinders) charts[chart.volume_id] = chart;
  ASSERT_EQ(charts.size(), 3u);
  for (const auto& hex : mesh.hexes) {
    if (!charts.count(hex.group)) continue;
    const auto& chart = charts.at(hex.group);
    std::array<double, 4> radius_m, angle_rad;
    for (int i = 0; i < 4; ++i) {
      const double x_m = mesh.x(hex.nodes[i]) - chart.axis_x_m, y_m = mesh.y(hex.nodes[i]) - chart.axis_y_m;
      radius_m[i] = std::hypot(x_m, y_m);
      angle_rad[i] = std::atan2(y_m, x_m);
    }
    const double pi = std::acos(-1.0), angle_rounding = rounding_m / chart.inner_radius_m * 10;
    ASSERT_NEAR(radius_m[0], radius_m[3], rounding_m);
    ASSERT_NEAR(radius_m[1], radius_m[2], rounding_m);
    ASSERT_NEAR(std::remainder(angle_rad[0] - angle_rad[1], 2 * pi), 0, angle_rounding);
    ASSERT_NEAR(std::remainder(angle_rad[3] - angle_rad[2], 2 * pi), 0, angle_rounding);
    ASSERT_GT(std::remainder(angle_rad[3] - angle_rad[0], 2 * pi), 0);
    // At most 0.25 are wanted; counts are rounded, which lengthens a cell by half at most. Well below the 30
    // degrees (0.52) from which on an edge is called sharp.
    ASSERT_LT(std::remainder(angle_rad[3] - angle_rad[0], 2 * pi), 0.375);
    ASSERT_GE(radius_m[0], chart.inner_radius_m - rounding_m);
    ASSERT_LE(radius_m[1], chart.outer_radius_m + rounding_m);
  }
}

TEST(ChamberMesh, HasCellsThatAreProductsInTheirCharts) {
  expect_product_cells(laboratory_chamber());
  expect_product_cells(lopsided_chamber());
  auto small_housing = laboratory_chamber();  // the webs' cells fan out by a factor of 3
  small_housing.housing.outer_radius_m = 0.045;
  small_housing.housing.bore_radius_m = 0.03;
  small_housing.webs.height_m = 0.08;
  expect_product_cells(small_housing);
}

/// A lug about as long as it is wide, round a corner of its pad, with few columns: one of them has to run
/// along the strip to the corner.
TEST(ChamberMesh, HasGoodCellsInAShortLugRoundItsPadsCorner) {
  meshes::Chamber chamber;
  chamber.tube = {0.2965, 0.03, 1.03, 0.5956, -0.0214};
  chamber.flanges = {0.37, 0.069};
  chamber.housing = {0.206, 0.158, 0.655};
  chamber.webs = {0.043, 0.16, {0}};
  chamber.lugs = {0.028, 0.174, 0.259};
  chamber.pads = {0.0745, 0.195, 0.057};
  chamber.feet = {{0.3012, 0.3308}};
  const auto body = meshes::build_chamber(chamber, {});
  EXPECT_GT(body.quality.min_scaled_jacobian, 0.35);
}

/// So that loads symmetrical in z have no moment about x and y, to the last bit of the coordinates.
TEST(ChamberMesh, IsSymmetricalInZIfTheChamberIs) {
  const auto body = meshes::build_chamber(laboratory_chamber(), {});
  const MeshFile mesh = read_mesh_file(body);
  std::set<std::array<double, 3>> points(mesh.points.begin(), mesh.points.end());
  for (const auto& p : mesh.points) ASSERT_EQ(points.count({p[0], p[1], -p[2]}), 1u) << p[2];
}

TEST(ChamberMesh, IsBitIdenticalWhenRepeated) {
  const auto first = msh_bytes(meshes::build_chamber(laboratory_chamber(), {}));
  msh_bytes(meshes::build_chamber(lopsided_chamber(), {}));
  EXPECT_GT(first.size(), 500000u);
  EXPECT_TRUE(msh_bytes(meshes::build_chamber(laboratory_chamber(), {})) == first);
}

}  // namespace
