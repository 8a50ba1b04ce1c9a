/// Zones on a row of cells whose answer can be written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/pipelines/examples/row_of_cells.h"

namespace {

using examples::edge_along;
using examples::Row;

TEST(Zones, RegionsThatShareNoCellAreApart) {
  Row row(4);
  row.layer(0, 80);
  row.layer(1, 60);
  row.layer(4, 20);
  row.layer(7, 90);
  row.layer(8, 100);
  row.envelope.value_Pa[9 * 8 + 4] = 110;
  const auto zones = find_zones(row.nodes, row.envelope, row.places(), 50, 220);
  ASSERT_EQ(zones.zones.size(), 2u);
  EXPECT_EQ(zones.zones[0].peak_Pa, 110);
  EXPECT_EQ(zones.zones[0].safety, 2);
  EXPECT_EQ(zones.zones[0].n_nodes, 18u);
  // From layer 8 down to where the line from 90 to 0 crosses 50.
  EXPECT_NEAR(zones.zones[0].volume_m3, 4 * (1 + 40. / 90), 1e-13);
  EXPECT_NEAR(zones.zones[1].volume_m3, 4 * (1 + 10. / 60), 1e-13);
  EXPECT_EQ(zones.zones[0].instant, 4);
  EXPECT_EQ(zones.zones[1].peak_Pa, 80);
  EXPECT_EQ(zones.zone_of_node[0], 2);
  EXPECT_EQ(zones.zone_of_node[9 * 8], 1);
  EXPECT_EQ(zones.zone_of_node[9 * 4], 0);
}

TEST(Zones, OneCellJoins) {
  Row row(1);
  row.layer(0, 80);
  row.layer(2, 60);  // not adjacent layers, but nodes of one cell
  EXPECT_EQ(find_zones(row.nodes, row.envelope, row.places(), 50, 200).zones.size(), 1u);
}

TEST(Zones, NamedAfterTheMostTellingFeature) {
  Row row(3);
  row.envelope.value_Pa[9 * 2] = 70;      // shared by "left" and "fillet"
  row.envelope.value_Pa[9 * 5 + 2] = 60;  // inside, nearest to the seat
  const auto zones = find_zones(row.nodes, row.envelope, row.places(), 50, 200);
  ASSERT_EQ(zones.zones.size(), 2u);
  EXPECT_EQ(zones.zones[0].feature, "fillet");
  EXPECT_EQ(zones.zones[0].place, pipelines::Place::free_surface);
  EXPECT_EQ(zones.zones[1].feature, "seat");
  EXPECT_EQ(zones.zones[1].place, pipelines::Place::interior);
  EXPECT_EQ(row.places().place[9 * 5], pipelines::Place::loaded_seat);
}

// A mill's charge is no seat: red if its wall is told as one.
TEST(Zones, TheChargePressesOnItsWall) {
  using pipelines::Place;
  const Row row(3);
  const auto places = pipelines::locate_nodes(row.nodes, row.features, row.ports, {}, {"seat"});
  EXPECT_EQ(places.place[9 * 5], Place::charged_wall);
  EXPECT_EQ(to_string(places.place[9 * 5]), "under the charge's pressure");
  EXPECT_EQ(places.place[0], Place::free_surface);
  const auto others = pipelines::locate_nodes(row.nodes, row.features, row.ports, {}, {"another"});
  EXPECT_EQ(to_string(others.place[9 * 5]), "under seat pressure");
}

TEST(Zones, SharpEdgesHoldNoPeak) {
  Row row(2);
  row.layer(0, 10);
  row.envelope.value_Pa[0] = 1000;  // at the origin
  const auto places = row.places({edge_along({{-1, 0, 0}, {0, 0, 0}}, 0.5)});
  EXPECT_EQ(row.envelope.value_Pa[pipelines::peak_node(row.envelope.value_Pa, places)], 10);
  const auto zones = find_zones(row.nodes, row.envelope, places, 5, 100);
  ASSERT_EQ(zones.zones.size(), 1u);
  EXPECT_EQ(zones.zones[0].peak_Pa, 10);
  EXPECT_EQ(zones.zone_of_node[0], 0);
  // Half a layer of the three boxes between nodes that do not hold the origin. The fourth is split along each
  // diagonal; of a tetrahedron with the origin three of four nodes count. Shares above the level by how many
  // nodes of the layer a tetrahedron has, without the origin and with it (1000 and one or two nodes at 10).
  const double one = 1. / 8, two = 1. / 2, three = 7. / 8;
  const double with_one = 0.75 * 0.9937625, with_two = 0.75 * (1 - 5. / 1000 * 5 / 10 * 5 / 10);
  const double from_origin = 2 * with_one + 2 * with_two, from_opposite = 2 * one + 2 * two + 2 * with_two,
               from_beside = 2 * one + two + with_one + three + with_two;  // twice
  EXPECT_NEAR(zones.zones[0].volume_m3, 3 * 0.5 + (from_origin + from_opposite + 2 * from_beside) / 24,
              1e-13);
}

// Distance is to the straight pieces, not to the lines through them (which pass (1, 1)) nor to the box around
// them. Nodes of the first layer lie at whole numbers.
TEST(Zones, ExclusionFollowsAnEdgeOfSeveralPieces) {
  const Row row(1);
  const auto places = row.places({edge_along({{0, 0, 0}, {0.5, 0.5, 0}, {2, 0.5, 0}, {2, 2.5, 0}}, 0.4)});
  std::vector<std::size_t> excluded;
  for (std::size_t i = 0; i < row.nodes.n; ++i)
    if (places.excluded[i]) excluded.push_back(i);
  EXPECT_EQ(excluded, (std::vector<std::size_t>{0, 5, 8}));
  const auto everywhere = row.places({edge_along({{0, 0, 0}, {1, 0, 0}}, 9)});
  EXPECT_THROW(pipelines::peak_node(row.envelope.value_Pa, everywhere), std::invalid_argument);
}

// Nodes at the distance itself are read: there stress can be compared from mesh to mesh. On the surfaces that
// want more the distance is theirs, inside the body and on others it is not.
TEST(Zones, ExclusionIsWiderOnAThickerPlatesSurface) {
  const Row row(3);  // layers at z = 0, 0.5, ... 3
  auto edge = edge_along({{0, 0, 0}, {1, 0, 0}}, 0.5);
  const auto without = row.places({edge});
  const int id = row.nodes.face_boundary_id.front();
  edge.distance_on_m = {{id, 1.25}};
  const auto with = row.places({edge});
  std::vector<char> on_surface(row.nodes.n, 0);
  for (std::size_t f = 0; f < row.nodes.n_faces(); ++f)
    if (row.nodes.face_boundary_id[f] == id)
      for (const auto node : row.nodes.face(f)) on_surface[std::size_t(node)] = 1;
  std::size_t n_more = 0;
  for (std::size_t i = 0; i < row.nodes.n; ++i) {
    const double* x = &row.nodes.xyz_m[3 * i];
    const double d = std::hypot(x[0] - std::clamp(x[0], 0.0, 1.0), x[1], x[2]);
    EXPECT_EQ(bool(without.excluded[i]), d < 0.499) << d;
    EXPECT_EQ(bool(with.excluded[i]), d < (on_surface[i] ? 1.2475 : 0.499)) << d;
    n_more += with.excluded[i] && !without.excluded[i];
  }
  EXPECT_GT(n_more, 0U);
}

TEST(Zones, ABodyWithoutStressHasNone) {
  Row row(2);
  EXPECT_TRUE(find_zones(row.nodes, row.envelope, row.places(), 0, 100).zones.empty());
}

}  // namespace
