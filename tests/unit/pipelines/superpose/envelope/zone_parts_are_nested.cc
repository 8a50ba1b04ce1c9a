/// Zones divided at higher levels, on a row of cells whose answer can be written down, and against a flood
/// fill.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "pipelines/superpose/envelope/zone_parts.h"
#include "tests/unit/pipelines/examples/row_of_cells.h"

namespace {

using pipelines::Zones;

Zones divided_row(const examples::Row& row, const pipelines::NodePlaces& places, double level_Pa) {
  return divided(find_zones(row.nodes, row.envelope, places, level_Pa, 220), row.nodes, row.envelope, places);
}

examples::Row row_of_layers(const std::vector<double>& values_Pa) {
  examples::Row row(int(values_Pa.size() - 1) / 2);
  for (std::size_t l = 0; l < values_Pa.size(); ++l) row.layer(l, values_Pa[l]);
  return row;
}

std::vector<std::string> numbers_of(const pipelines::Zone& zone) {
  std::vector<std::string> numbers;
  for (const auto& part : zone.parts) numbers.push_back(part.number);
  return numbers;
}

using Numbers = std::vector<std::string>;

TEST(ZoneParts, TwoPeaksOfOneZoneAreTwoParts) {
  const auto row = row_of_layers({100, 80, 60, 55, 60, 65, 75, 95, 60});
  const auto zones = divided_row(row, row.places(), 50);
  ASSERT_EQ(zones.zones.size(), 1u);
  const auto& zone = zones.zones[0];
  ASSERT_EQ(numbers_of(zone), (Numbers{"1.1", "1.1.1", "1.2", "1.2.1"}));
  for (const auto& [i, level, share, peak, n, z] :
       {std::tuple{0, 70., 0.7, 100., 18u, 0.}, std::tuple{1, 90., 0.9, 100., 9u, 0.},
        std::tuple{2, 70., 0.7, 95., 18u, 7.}, std::tuple{3, 90., 0.9, 95., 9u, 7.}}) {
    const auto& part = zone.parts[std::size_t(i)];
    EXPECT_EQ(part.level_Pa, level) << part.number;
    EXPECT_EQ(part.share_of_peak, share) << part.number;
    EXPECT_EQ(part.peak_Pa, peak) << part.number;
    EXPECT_EQ(part.n_nodes, n) << part.number;
    EXPECT_EQ(part.peak_m[2], z) << part.number;
    EXPECT_EQ(part.peak_node, std::size_t(9 * z)) << "the first of equal ones";
    EXPECT_EQ(part.instant, 4) << part.number;
  }
  EXPECT_EQ(zone.parts[0].feature, "left");
  EXPECT_EQ(zone.parts[2].feature, "seat");
  EXPECT_EQ(zone.parts[2].place, pipelines::Place::loaded_seat);
  const auto splits = splits_of(zone);
  ASSERT_EQ(splits.size(), 1u) << "two at 90 % as at 70 %";
  EXPECT_EQ(splits[0].share_of_peak, 0.7);
  EXPECT_EQ(splits[0].n_parts, 2u);
}

TEST(ZoneParts, SplitAtTheLevelThatNothingConnects) {
  const auto row = row_of_layers({95, 75, 80, 72, 100});
  const auto zones = divided_row(row, row.places(), 50);
  const auto& zone = zones.zones.at(0);
  ASSERT_EQ(numbers_of(zone), (Numbers{"1.1", "1.1.1", "1.1.2"}));
  EXPECT_EQ(zone.parts[0].n_nodes, 45u);
  EXPECT_EQ(zone.parts[1].peak_m[2], 4) << "the higher peak comes first";
  EXPECT_EQ(zone.parts[2].peak_m[2], 0);
  const auto splits = splits_of(zone);
  ASSERT_EQ(splits.size(), 1u);
  EXPECT_EQ(splits[0].share_of_peak, 0.9);
}

TEST(ZoneParts, OneCellJoinsThemAsItJoinsZones) {
  const auto row = row_of_layers({100, 60, 95});
  const auto zones = divided_row(row, row.places(), 50);
  EXPECT_EQ(numbers_of(zones.zones.at(0)), (Numbers{"1.1", "1.1.1"}));
  EXPECT_TRUE(splits_of(zones.zones[0]).empty());
}

TEST(ZoneParts, APlateauIsOnePieceAndEqualPeaksKeepTheOrderOfNodes) {
  const auto flat = row_of_layers({100, 100, 100, 100, 100});
  const auto whole = divided_row(flat, flat.places(), 50);
  ASSERT_EQ(numbers_of(whole.zones.at(0)), (Numbers{"1.1", "1.1.1"}));
  EXPECT_EQ(whole.zones[0].parts[1].n_nodes, 45u);
  EXPECT_EQ(whole.zones[0].parts[1].peak_node, 0u);

  const auto twins = row_of_layers({60, 100, 60, 60, 60, 60, 60, 100, 60});
  const auto divided_twins = divided_row(twins, twins.places(), 50);
  const auto& parts = divided_twins.zones.at(0).parts;
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].peak_node, 9u);
  EXPECT_EQ(parts[2].peak_node, 63u);
}

TEST(ZoneParts, BelongToTheirZoneAndLowZonesHaveNone) {
  const auto row = row_of_layers({60, 20, 0, 0, 95, 0, 0, 0, 100});
  const auto before = find_zones(row.nodes, row.envelope, row.places(), 50, 220);
  const auto zones = divided(before, row.nodes, row.envelope, row.places());
  ASSERT_EQ(zones.zones.size(), 3u);
  EXPECT_EQ(numbers_of(zones.zones[0]), (Numbers{"1.1", "1.1.1"}));
  EXPECT_EQ(numbers_of(zones.zones[1]), (Numbers{"2.1", "2.1.1"}));
  EXPECT_EQ(zones.zones[1].parts[0].level_Pa, 70) << "of the body's peak, not of the zone's";
  EXPECT_TRUE(zones.zones[2].parts.empty()) << "its peak is 60 %";
  EXPECT_EQ(zones.zone_of_node, before.zone_of_node);
  for (std::size_t z = 0; z < 3; ++z) EXPECT_EQ(zones.zones[z].peak_node, before.zones[z].peak_node);
}

TEST(ZoneParts, LevelsBelowThatOfTheZonesSayNothing) {
  const auto row = row_of_layers({95, 75, 85, 82, 100});
  const auto zones = divided_row(row, row.places(), 80);
  ASSERT_EQ(zones.zones.size(), 1u);
  EXPECT_EQ(numbers_of(zones.zones[0]), (Numbers{"1.1", "1.2"}));
  EXPECT_EQ(zones.zones[0].parts[0].share_of_peak, 0.9);
  EXPECT_TRUE(divided_row(row, row.places(), 95).zones.at(0).parts.empty());
}

// A whole layer in the middle is excluded, the largest values of the body with it.
TEST(ZoneParts, ExcludedNodesAreInNone) {
  auto row = row_of_layers({100, 95, 80, 1000, 80, 80, 92});
  std::vector<std::array<double, 3>> through;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) through.push_back({double(y % 2 == 0 ? x : 2 - x), double(y), 3});
  const auto places = row.places({examples::edge_along(through, 0.5)});
  ASSERT_EQ(std::count(places.excluded.begin(), places.excluded.end(), char(1)), 9);
  const auto zones = divided_row(row, places, 50);
  ASSERT_EQ(zones.zones.size(), 1u) << "the cell of layers 2 to 4 joins its ends";
  const auto& parts = zones.zones[0].parts;
  ASSERT_EQ(numbers_of(zones.zones[0]), (Numbers{"1.1", "1.1.1", "1.1.2"}));
  EXPECT_EQ(parts[0].level_Pa, 70);
  EXPECT_EQ(parts[0].n_nodes, 54u);
  EXPECT_EQ(parts[1].n_nodes, 18u);
  EXPECT_EQ(parts[2].n_nodes, 9u);
}

/// Peak and number of nodes of every connected region above a level.
std::multiset<std::pair<double, std::size_t>> flooded(const examples::Row& row, double level_Pa) {
  std::multiset<std::pair<double, std::size_t>> regions;
  std::vector<char> seen(row.nodes.n, 0);
  const auto is_above = [&](std::size_t i) { return row.envelope.value_Pa[i] >= level_Pa; };
  for (std::size_t start = 0; start < row.nodes.n; ++start) {
    if (seen[start] || !is_above(start)) continue;
    std::vector<std::size_t> front{start};
    seen[start] = 1;
    double peak = 0;
    std::size_t n = 0;
    while (!front.empty()) {
      const auto node = front.back();
      front.pop_back();
      peak = std::max(peak, row.envelope.value_Pa[node]);
      ++n;
      for (std::size_t c = 0; c < row.nodes.n_cells(); ++c) {
        const auto cell = row.nodes.cell(c);
        if (std::find(cell.begin(), cell.end(), std::int32_t(node)) == cell.end()) continue;
        for (const auto other : cell)
          if (!seen[std::size_t(other)] && is_above(std::size_t(other))) {
            seen[std::size_t(other)] = 1;
            front.push_back(std::size_t(other));
          }
      }
    }
    regions.insert({peak, n});
  }
  return regions;
}

TEST(ZoneParts, AreThoseOfAFloodFill) {
  std::mt19937 random(11);
  std::size_t n_split = 0;
  for (int trial = 0; trial < 20; ++trial) {
    examples::Row row(40);
    double value = 60;
    for (std::size_t l = 0; l < 81; ++l) {
      value = std::clamp(value + double(random() % 33) - 16, 40.0, 98.0);
      row.layer(l, value);
    }
    row.envelope.value_Pa[random() % row.nodes.n] = 100;
    const auto zones = divided_row(row, row.places(), 50);
    std::map<double, std::multiset<std::pair<double, std::size_t>>> found;
    for (const auto& zone : zones.zones) {
      n_split += splits_of(zone).size();
      for (const auto& part : zone.parts) {
        found[part.level_Pa].insert({part.peak_Pa, part.n_nodes});
        const auto parent = part.number.substr(0, part.number.rfind('.'));
        for (const auto& other : zone.parts)
          if (other.number == parent) {
            EXPECT_GE(other.peak_Pa, part.peak_Pa);
            EXPECT_GE(other.n_nodes, part.n_nodes);
          }
      }
    }
    EXPECT_EQ(found[70], flooded(row, 70)) << trial;
    EXPECT_EQ(found[90], flooded(row, 90)) << trial;
  }
  EXPECT_GT(n_split, 10u) << "the fields try it";
}

}  // namespace
