#include "pipelines/superpose/envelope/zone_parts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "pipelines/superpose/envelope/disjoint_sets.h"

namespace pipelines {
namespace {

/// A connected region at one level, and the regions at the next higher one that it holds.
struct Region {
  std::size_t peak_node = 0, n_nodes = 0;
  std::vector<Region> within;
};

bool has_higher_peak(const NodalMaximum& envelope, const Region& a, const Region& b) {
  const double of_a = envelope.value_Pa[a.peak_node], of_b = envelope.value_Pa[b.peak_node];
  return of_a != of_b ? of_a > of_b : a.peak_node < b.peak_node;
}

/// Nodes of the zones at or above a level, joined where they share a cell.
void join_above(const fem::Nodes& nodes, const std::vector<char>& inside, DisjointSets& sets) {
  for (std::size_t cell = 0; cell < nodes.n_cells(); ++cell) {
    std::int32_t first = -1;
    for (const auto node : nodes.cell(cell)) {
      if (!inside[std::size_t(node)]) continue;
      if (first < 0)
        first = node;
      else
        sets.join(std::size_t(first), std::size_t(node));
    }
  }
}

/// The regions of one level with what they hold of the level above.
std::vector<Region> regions_with(std::vector<Region> higher, const std::vector<char>& inside,
                                 const NodalMaximum& envelope, DisjointSets& sets) {
  std::map<std::size_t, Region> by_root;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) continue;
    auto& region = by_root[sets.find(i)];
    if (region.n_nodes == 0 || envelope.value_Pa[i] > envelope.value_Pa[region.peak_node])
      region.peak_node = i;
    region.n_nodes += 1;
  }
  for (auto& region : higher) by_root.at(sets.find(region.peak_node)).within.push_back(std::move(region));
  std::vector<Region> regions;
  for (auto& [root, region] : by_root) regions.push_back(std::move(region));
  std::sort(regions.begin(), regions.end(),
            [&](const auto& a, const auto& b) { return has_higher_peak(envelope, a, b); });
  for (auto& region : regions)
    std::sort(region.within.begin(), region.within.end(),
              [&](const auto& a, const auto& b) { return has_higher_peak(envelope, a, b); });
  return regions;
}

struct Level {
  double level_Pa = 0, share_of_peak = 0;
};

/// The region and all within it, each before what it holds.
void append(const Region& region, const std::string& number, const std::vector<Level>& levels,
            std::size_t depth, const fem::Nodes& nodes, const NodalMaximum& envelope,
            const NodePlaces& places, std::vector<ZonePart>& parts) {
  const std::size_t node = region.peak_node;
  ZonePart part;
  part.number = number;
  part.level_Pa = levels[depth].level_Pa;
  part.share_of_peak = levels[depth].share_of_peak;
  part.peak_node = node;
  part.peak_Pa = envelope.value_Pa[node];
  std::copy_n(&nodes.xyz_m[3 * node], 3, part.peak_m.begin());
  part.instant = envelope.instant[node];
  part.n_nodes = region.n_nodes;
  part.feature = feature_at(nodes, places, node);
  part.place = places.place[node];
  parts.push_back(std::move(part));
  for (std::size_t i = 0; i < region.within.size(); ++i)
    append(region.within[i], number + "." + std::to_string(i + 1), levels, depth + 1, nodes, envelope, places,
           parts);
}

}  // namespace

Zones divided(Zones zones, const fem::Nodes& nodes, const NodalMaximum& envelope, const NodePlaces& places) {
  for (auto& zone : zones.zones) zone.parts.clear();
  if (zones.zones.empty()) return zones;
  const double peak_Pa = zones.zones.front().peak_Pa;  // the body's peak: the first zone holds it
  std::vector<Level> levels;
  for (const double share : part_levels)
    if (share * peak_Pa > zones.level_Pa) levels.push_back({share * peak_Pa, share});
  // From the highest level down, so that sets only grow.
  DisjointSets sets(nodes.n);
  std::vector<char> inside(nodes.n, 0);
  std::vector<Region> regions;
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    for (std::size_t i = 0; i < nodes.n; ++i)
      inside[i] = zones.zone_of_node[i] > 0 && envelope.value_Pa[i] >= level->level_Pa;
    join_above(nodes, inside, sets);
    regions = regions_with(std::move(regions), inside, envelope, sets);
  }
  std::vector<std::size_t> n_parts(zones.zones.size(), 0);
  for (const auto& region : regions) {
    const auto zone = std::size_t(zones.zone_of_node[region.peak_node] - 1);
    append(region, std::to_string(zone + 1) + "." + std::to_string(++n_parts[zone]), levels, 0, nodes,
           envelope, places, zones.zones[zone].parts);
  }
  return zones;
}

std::vector<Split> splits_of(const Zone& zone) {
  std::vector<Split> splits;
  std::size_t n_before = 1;
  for (const double share : part_levels) {
    const auto n = std::size_t(std::count_if(zone.parts.begin(), zone.parts.end(), [&](const ZonePart& part) {
      return part.share_of_peak == share;
    }));
    if (n > n_before) splits.push_back({share, n});
    n_before = std::max(n, n_before);
  }
  return splits;
}

}  // namespace pipelines
