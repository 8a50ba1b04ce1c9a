/// Hot spots and sharp edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "meshes/chamber/chamber.h"
#include "meshes/checks/sharp_edges.h"
#include "meshes/spacing/swept_plan.h"
#include "tests/unit/meshes/examples/chamber_solids.h"
#include "tests/unit/meshes/examples/example_chambers.h"
#include "tests/unit/meshes/examples/example_shafts.h"
#include "tests/unit/meshes/examples/mesh_file.h"

namespace {

using Point = std::array<double, 3>;

double distance_m(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Along the tube's outside.
double on_surface_m(const meshes::Chamber& chamber, const Point& a, const Point& b) {
  const double r_m = chamber.tube.inner_radius_m + chamber.tube.wall_m, pi = std::acos(-1.0);
  const auto angle = [&](const Point& p) {
    return std::atan2(p[1] - chamber.tube.axis_y_m, p[0] - chamber.tube.axis_x_m);
  };
  return std::hypot(r_m * std::remainder(angle(b) - angle(a), 2 * pi), b[2] - a[2]);
}

/// Points are vertices of "tube outside" (to the rounding of the file), the toe is on an edge that the plate
/// shares with the tube, and the two others lie 0.4 and 1.0 walls away.
void expect_hot_spots_in_place(const meshes::Chamber& chamber) {
  const auto body = meshes::build_chamber(chamber, {});
  const MeshFile mesh = read_mesh_file(body);
  std::map<std::string, std::set<int>> groups;
  for (const auto& quad : mesh.quads)
    groups[mesh.boundary_names.at(quad.group)].insert(quad.nodes.begin(), quad.nodes.end());
  const auto is_vertex_of = [&](const std::string& group, const Point& p) {
    for (const int node : groups.at(group))
      if (distance_m(mesh.points[node], p) < 1e-12) return true;
    return false;
  };
  std::set<std::string> names;
  const double wall_m = chamber.tube.wall_m;
  for (const auto& spot : body.hot_spots) {
    SCOPED_TRACE(spot.name);
    EXPECT_TRUE(names.insert(spot.name).second);
    EXPECT_EQ(spot.thickness_m, wall_m);
    for (const auto& p : {spot.toe_m, spot.near_m, spot.far_m}) EXPECT_TRUE(is_vertex_of("tube outside", p));
    const std::string plate = spot.name.substr(0, 5);  // "web 1"
    EXPECT_TRUE(is_vertex_of(plate, spot.toe_m));
    EXPECT_FALSE(is_vertex_of(plate, spot.near_m));
    EXPECT_NEAR(on_surface_m(chamber, spot.toe_m, spot.near_m), 0.4 * wall_m, 1e-12);
    EXPECT_NEAR(on_surface_m(chamber, spot.near_m, spot.far_m), 0.6 * wall_m, 1e-12);
    EXPECT_NEAR(on_surface_m(chamber, spot.toe_m, spot.far_m), wall_m, 1e-12);
  }
}

/// Shortest edge on the tube's outside from a vertex of it.
double shortest_edge_m(const MeshFile& mesh, const Point& from) {
  double shortest_m = 1e300;
  for (const auto& quad : mesh.quads) {
    if (mesh.boundary_names.at(quad.group) != "tube outside") continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto &a = mesh.points[quad.nodes[i]], &b = mesh.points[quad.nodes[(i + 1) % 4]];
      if (distance_m(a, from) < 1e-12 || distance_m(b, from) < 1e-12)
        shortest_m = std::min(shortest_m, distance_m(a, b));
    }
  }
  return shortest_m;
}

// Cells shrink at the toes beside a fine place and through the wall there, not at those of other plates; the
// hot spots stay where they are.
TEST(FineToes, GetSmallCellsWhereTheyAre) {
  const auto chamber = laboratory_chamber();
  const double wall_m = chamber.tube.wall_m;
  const auto usual = meshes::build_chamber(chamber, {});
  meshes::ChamberMeshControl control;
  control.cells_through_wall = 4;
  control.fine_toes = {{usual.hot_spots.front().toe_m, 0.1}};
  const auto fine = meshes::build_chamber(chamber, control);
  const MeshFile before = read_mesh_file(usual), after = read_mesh_file(fine);
  ASSERT_EQ(usual.hot_spots.size(), fine.hot_spots.size());
  for (std::size_t i = 0; i < usual.hot_spots.size(); ++i) {
    const auto& spot = usual.hot_spots[i];
    SCOPED_TRACE(spot.name);
    EXPECT_LT(distance_m(spot.toe_m, fine.hot_spots[i].toe_m), 1e-12);
    const double shortest_m = shortest_edge_m(after, spot.toe_m);
    if (on_surface_m(chamber, spot.toe_m, usual.hot_spots.front().toe_m) < wall_m) {
      EXPECT_LT(shortest_m, 0.15 * wall_m);  // it grows within the first cell already
    } else if (spot.name.rfind("lug", 0) == 0) {
      EXPECT_GT(shortest_m, 0.9 * shortest_edge_m(before, spot.toe_m));
    }
  }
  EXPECT_LT(fine.quality.n_cells, 4 * usual.quality.n_cells);  // two of the four are the wall's
}

TEST(HotSpots, AreVerticesAtTheWeldToes) {
  expect_hot_spots_in_place(laboratory_chamber());
  expect_hot_spots_in_place(lopsided_chamber());
}

/// Eight for each of 2 webs and 4 lugs; names say where they are.
TEST(HotSpots, OfTheLaboratoryAreComplete) {
  const auto body = meshes::build_chamber(laboratory_chamber(), {});
  EXPECT_EQ(body.hot_spots.size(), 48u);
  std::map<std::string, meshes::HotSpot> spots;
  for (const auto& spot : body.hot_spots) spots[spot.name] = spot;
  const auto& upper = spots.at("web 2, upper edge");
  EXPECT_NEAR(upper.toe_m[2], 0.045, 1e-12);
  EXPECT_GT(upper.far_m[1], upper.toe_m[1]);
  const auto& lower = spots.at("web 1, lower edge");
  EXPECT_NEAR(lower.toe_m[2], -0.045, 1e-12);
  EXPECT_LT(lower.far_m[1], lower.toe_m[1]);
  // 140 mm apart at the tube.
  EXPECT_NEAR(std::hypot(upper.toe_m[0] - lower.toe_m[0], upper.toe_m[1] - lower.toe_m[1]), 0.14, 1e-12);
  const auto& front = spots.at("web 2, front face, middle");
  EXPECT_NEAR(front.toe_m[2], 0.052, 1e-12);
  EXPECT_NEAR(front.far_m[2], 0.058, 1e-12);
  const auto& back = spots.at("lug 2 front, back face, upper end");
  EXPECT_NEAR(back.toe_m[2], 0.096, 1e-12);
  EXPECT_NEAR(back.far_m[2], 0.090, 1e-12);
}

/// Where a lug lies in front of a web within one wall, no path is read between them.
TEST(HotSpots, AreLeftOutWhereAnotherPlateIsInTheWay) {
  auto chamber = lopsided_chamber();
  chamber.webs.z_m = {-50e-3, 5e-3, 55e-3};
  chamber.lugs.z_m = 71e-3;  // faces at 60 and 67 mm
  const auto body = meshes::build_chamber(chamber, {});
  bool has_other_end = false;
  for (const auto& spot : body.hot_spots) {
    EXPECT_NE(spot.name, "lug 1 front, back face, upper end");
    has_other_end |= spot.name == "lug 2 front, back face, upper end";
  }
  EXPECT_TRUE(has_other_end);
  const auto& covered = body.covered_toes;
  EXPECT_EQ(std::count(covered.begin(), covered.end(), "lug 1 front, back face, upper end"), 1);
}

/// An edge that happens to run 0.04 mm from a point of a path takes its place: lugs of 43 mm instead of 40 mm
/// end 5.96 mm from the web's lower toe, whose farther point is at 6 mm.
TEST(HotSpots, AreReadBesideEdgesOfOtherPlates) {
  auto chamber = laboratory_chamber();
  chamber.lugs.width_m = 43e-3;
  const double wall_m = chamber.tube.wall_m, closest_m = 0.05 * wall_m;
  for (const bool lean : {false, true}) {
    meshes::ChamberMeshControl control;
    control.lean = lean;
    const auto body = meshes::build_chamber(chamber, control);
    EXPECT_EQ(body.hot_spots.size(), 48u);
    EXPECT_TRUE(body.covered_toes.empty());
    int n_moved = 0;
    for (const auto& spot : body.hot_spots) {
      EXPECT_NEAR(on_surface_m(chamber, spot.toe_m, spot.near_m), 0.4 * wall_m, 1e-12) << spot.name;
      const double far_m = on_surface_m(chamber, spot.toe_m, spot.far_m);
      EXPECT_NEAR(far_m, wall_m, closest_m) << spot.name;
      n_moved += std::abs(far_m - wall_m) > 1e-12;
    }
    EXPECT_EQ(n_moved, 4);  // from the lower edges of both webs, and from those of the lugs that face them
  }
}

std::map<std::string, meshes::SharpEdge> sharp_edges_of(const meshes::BodyMesh& body) {
  std::map<std::string, meshes::SharpEdge> edges;
  for (const auto& edge : body.sharp_edges) edges[edge.name] = edge;
  return edges;
}

double length_m(const meshes::SharpEdge& edge) {
  double sum = 0;
  for (const auto& piece : edge.pieces) sum += distance_m(piece[0], piece[1]);
  return sum;
}

/// All weld toes, each with the whole length of its seam, and nothing else: the concave inner wall and bore
/// turn by 8 to 14 degrees from cell to cell. Seams around tube and housing are arcs: the cells' chords run
/// inside of them by 5 % of what is left out, and are too short by 1e-3.
TEST(SharpEdges, OfTheChamberAreItsWeldToes) {
  const auto chamber = laboratory_chamber();
  const auto body = meshes::build_chamber(chamber, {});
  const auto edges = sharp_edges_of(body);
  const auto outlines = outlines_of(chamber, angles_of(read_mesh_file(body), chamber));
  const auto polyline_m = [](const Corners& corners) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      sum += std::hypot(corners[i + 1][0] - corners[i][0], corners[i + 1][1] - corners[i][1]);
    return sum;
  };
  const double tube_m = chamber.tube.inner_radius_m + chamber.tube.wall_m,
               housing_m = chamber.housing.outer_radius_m;
  const auto arcs_m = [](const Corners& corners, double radius_m) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      sum += 2 * radius_m *
             std::asin(std::hypot(corners[i + 1][0] - corners[i][0], corners[i + 1][1] - corners[i][1]) / 2 /
                       radius_m);
    return sum;
  };
  auto circle = outlines.tube_outer;
  circle.push_back(circle.front());
  struct Expected {
    std::string name;
    double length_m, distance_m;
    double radius_m = 1;  // of arcs
  };
  std::vector<Expected> expected;
  for (const std::string i : {"1", "2"}) {
    const std::size_t k = i == "1" ? 0 : 1;
    expected.push_back({"flange " + i + "/tube outside", arcs_m(circle, tube_m), 0.006, tube_m});
    expected.push_back(
        {"web " + i + "/tube outside", 2 * arcs_m(outlines.web_tube_arc, tube_m) + 2 * 0.014, 0.006, tube_m});
    expected.push_back({"web " + i + "/housing outside",
                        2 * arcs_m(outlines.web_housing_arc, housing_m) + 2 * 0.014, 0.014, housing_m});
    expected.push_back({"lug " + i + "/tube outside",
                        4 * arcs_m(outlines.lug_tube_arcs[k], tube_m) + 4 * 0.008, 0.006, tube_m});
    expected.push_back({"lug " + i + "/pad " + i, 4 * polyline_m(outlines.lug_ends[k]) + 4 * 0.008, 0.008});
  }
  EXPECT_EQ(edges.size(), expected.size());
  for (const auto& e : expected) {
    ASSERT_EQ(edges.count(e.name), 1u) << e.name;
    // A chord is shorter than its arc by a third of its arrow, 5e-3 of the distance at most, over the radius.
    EXPECT_LT(length_m(edges.at(e.name)), e.length_m + 1e-12) << e.name;
    EXPECT_GT(length_m(edges.at(e.name)), e.length_m * (1 - 5e-3 * e.distance_m / e.radius_m / 3) - 1e-12)
        << e.name;
    EXPECT_NEAR(edges.at(e.name).distance_m, e.distance_m, 1e-15) << e.name;
  }
  // On a plate's own surface its thickness, at most twice the other's.
  std::map<std::string, int> ids;
  for (const auto& feature : body.features) ids[feature.name] = feature.boundary_id;
  const auto on = [&](const std::string& edge, const std::string& surface) {
    return edges.at(edge).distance_on_m.at(ids.at(surface));
  };
  EXPECT_NEAR(on("web 1/tube outside", "tube outside"), 0.006, 1e-15);
  EXPECT_NEAR(on("web 1/tube outside", "web 1"), 0.012, 1e-15);  // of 14 mm
  EXPECT_NEAR(on("lug 1/tube outside", "lug 1"), 0.008, 1e-15);
  EXPECT_NEAR(on("web 1/housing outside", "housing outside"), 0.0175, 1e-15);
}

/// An L-shaped bar: one re-entrant edge, and five convex ones that must not count. With the leg tilted away
/// the edge turns by 45 degrees only and counts or not as the limit says.
TEST(SharpEdges, AreFoundOnAnyMesh) {
  const double half = std::sqrt(0.5);
  for (const bool right_angle : {true, false}) {
    meshes::Plan plan;
    const Point tip = right_angle ? Point{1, 2, 0} : Point{1 - half, 1 + half, 0};
    plan.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {-0.5, 2}, {tip[0], tip[1]}, {2, 0}, {2, 1}};
    meshes::PlanBlock block;
    block.quads = {{{0, 1, 2, 3}, {}}, {{3, 2, 5, 4}, {11, 12, 11, 11}}, {{1, 6, 7, 2}, {}}};
    block.slabs = {{0, 1, 1, 10, 13, 13}};
    plan.blocks = {block};
    const auto mesh = meshes::sweep(plan, {0, 0.25, 1});
    const std::map<int, meshes::PlateSurface> surfaces = {
        {10, {"foot", 0.3}}, {11, {"back", 0.1}}, {12, {"leg", 0.2}}, {13, {"end", 0.1}}};
    const auto edges = meshes::find_sharp_edges(mesh, surfaces);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_EQ(edges[0].name, "leg/foot");
    EXPECT_EQ(edges[0].distance_m, 0.2);
    ASSERT_EQ(edges[0].pieces.size(), 2u);
    for (const auto& piece : edges[0].pieces)
      for (const auto& end : piece) EXPECT_NEAR(std::hypot(end[0] - 1, end[1] - 1), 0, 1e-15);
    EXPECT_NEAR(length_m(edges[0]), 1, 1e-15);
    const double sixty_degrees = std::acos(0.5);
    EXPECT_EQ(meshes::find_sharp_edges(mesh, surfaces, sixty_degrees).size(), right_angle ? 1u : 0u);
  }
}

// A mesh that is cut later has the same points, on fewer cells.
TEST(Chamber, IsLeanWithTheSameHotSpots) {
  const auto chamber = laboratory_chamber();
  meshes::ChamberMeshControl control;
  const auto full = meshes::build_chamber(chamber, control);
  control.lean = true;
  control.toe_walls = meshes::ChamberMeshControl::lean_toe_walls;
  const auto lean = meshes::build_chamber(chamber, control);
  EXPECT_LT(lean.quality.n_cells, full.quality.n_cells / 2);
  ASSERT_EQ(lean.hot_spots.size(), full.hot_spots.size());
  for (std::size_t i = 0; i < lean.hot_spots.size(); ++i) {
    EXPECT_EQ(lean.hot_spots[i].name, full.hot_spots[i].name);
    EXPECT_EQ(lean.hot_spots[i].toe_m, full.hot_spots[i].toe_m);
    EXPECT_EQ(lean.hot_spots[i].near_m, full.hot_spots[i].near_m);
    EXPECT_EQ(lean.hot_spots[i].far_m, full.hot_spots[i].far_m);
  }
}

}  // namespace
