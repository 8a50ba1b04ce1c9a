#include "pipelines/superpose/envelope/zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "fem/stress/cells/region_volume.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/superpose/envelope/disjoint_sets.h"

namespace pipelines {
namespace {

/// A node shared by several features is named after the most specific one.
int precedence(meshes::Feature::Kind kind) {
  using Kind = meshes::Feature::Kind;
  switch (kind) {
    case Kind::fillet:
      return 0;
    case Kind::seat:
    case Kind::bore:
      return 1;
    case Kind::shoulder:
      return 2;
    case Kind::surface:
      return 3;
    case Kind::end_face:
      return 4;
  }
  return 5;
}

double distance_squared(const double* a, const double* b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

double distance_to_piece(const double* p, const std::array<std::array<double, 3>, 2>& piece) {
  double along = 0, length_squared = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double d = piece[1][c] - piece[0][c];
    along += (p[c] - piece[0][c]) * d;
    length_squared += d * d;
  }
  const double t = length_squared > 0 ? std::clamp(along / length_squared, 0.0, 1.0) : 0.0;
  std::array<double, 3> foot;
  for (std::size_t c = 0; c < 3; ++c) foot[c] = piece[0][c] + t * (piece[1][c] - piece[0][c]);
  return std::sqrt(distance_squared(p, foot.data()));
}

/// Nodes at the distance itself are read: meshes have rows there, at which stress can be compared from mesh
/// to mesh. Along an arc of 0.15 radii, the thickest wall, the straight distance is 0.1 % shorter.
constexpr double within = 1 - 2e-3;

/// Marks the nodes within the edge's distance, and those on surfaces of which the edge wants more.
void exclude_around(const fem::Nodes& nodes, const meshes::SharpEdge& edge, NodePlaces& places) {
  double largest_m = edge.distance_m;
  for (const auto& [id, distance_m] : edge.distance_on_m) largest_m = std::max(largest_m, distance_m);
  std::array<double, 3> low, high;  // box around the whole edge: most nodes are far from it
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const auto& piece : edge.pieces)
    for (const auto& end : piece)
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], end[c] - largest_m);
        high[c] = std::max(high[c], end[c] + largest_m);
      }
  const auto exclude_within = [&](double distance_m, std::size_t i) {
    const double* p = &nodes.xyz_m[3 * i];
    bool near = !places.excluded[i];
    for (std::size_t c = 0; c < 3 && near; ++c) near = p[c] >= low[c] && p[c] <= high[c];
    if (near && std::any_of(edge.pieces.begin(), edge.pieces.end(), [&](const auto& piece) {
          return distance_to_piece(p, piece) <= distance_m * within;
        }))
      places.excluded[i] = 1;
  };
  for (std::size_t i = 0; i < nodes.n; ++i) exclude_within(edge.distance_m, i);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    if (const auto own = edge.distance_on_m.find(nodes.face_boundary_id[f]); own != edge.distance_on_m.end())
      for (const auto node : nodes.face(f)) exclude_within(own->second, std::size_t(node));
}

/// The feature of the boundary node nearest to an interior point; ties go to the lower index.
std::int32_t nearest_feature(const fem::Nodes& nodes, const NodePlaces& places, std::size_t node) {
  double best = std::numeric_limits<double>::max();
  std::int32_t feature = -1;
  for (std::size_t i = 0; i < nodes.n; ++i) {
    if (places.feature[i] < 0) continue;
    const double d = distance_squared(&nodes.xyz_m[3 * i], &nodes.xyz_m[3 * node]);
    if (d < best) {
      best = d;
      feature = places.feature[i];
    }
  }
  return feature;
}

/// Nodes inside, joined where they share a cell.
template <typename Inside>
DisjointSets connected(const fem::Nodes& nodes, const Inside& inside) {
  DisjointSets sets(nodes.n);
  for (std::size_t cell = 0; cell < nodes.n_cells(); ++cell) {
    std::int32_t first = -1;
    for (const auto node : nodes.cell(cell)) {
      if (!inside(std::size_t(node))) continue;
      if (first < 0)
        first = node;
      else
        sets.join(std::size_t(first), std::size_t(node));
    }
  }
  return sets;
}

/// Calls back with a node inside and the volume of every cell that has one.
template <typename Inside, typename Take>
void for_cells_of_regions(const fem::Nodes& nodes, const Inside& inside,
                          const std::vector<double>& volumes_m3, const Take& take) {
  for (std::size_t cell = 0; cell < volumes_m3.size(); ++cell) {
    const auto cell_nodes = nodes.cell(cell);
    const auto node =
        std::find_if(cell_nodes.begin(), cell_nodes.end(), [&](auto i) { return inside(std::size_t(i)); });
    if (node != cell_nodes.end()) take(std::size_t(*node), volumes_m3[cell]);
  }
}

}  // namespace

double distance_m(const std::array<double, 3>& point, const meshes::SharpEdge& edge) {
  double nearest = std::numeric_limits<double>::max();
  for (const auto& piece : edge.pieces) nearest = std::min(nearest, distance_to_piece(point.data(), piece));
  return nearest;
}

std::vector<double> beyond_left_out_m(const fem::Nodes& nodes, const NodePlaces& places,
                                      const std::vector<meshes::SharpEdge>& edges) {
  const auto is_excluded = [&](std::int32_t i) { return places.excluded[std::size_t(i)] != 0; };
  std::vector<char> is_near(nodes.n, 0);
  bool is_any = false;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::none_of(cell.begin(), cell.end(), is_excluded)) continue;
    is_any = true;
    for (const auto i : cell) is_near[std::size_t(i)] = 1;
  }
  if (!is_any) return {};
  double largest_m = 0;
  for (const auto& edge : edges) largest_m = std::max(largest_m, edge.distance_m);
  std::vector<double> beyond_m(nodes.n, largest_m);
  const auto come_nearer = [&](std::size_t i, const meshes::SharpEdge& edge, double border_m) {
    const double* x = &nodes.xyz_m[3 * i];
    beyond_m[i] = std::min(beyond_m[i], distance_m({x[0], x[1], x[2]}, edge) - within * border_m);
  };
  for (const auto& edge : edges) {
    for (std::size_t i = 0; i < nodes.n; ++i)
      if (is_near[i] != 0) come_nearer(i, edge, edge.distance_m);
    for (std::size_t f = 0; f < nodes.n_faces(); ++f)
      if (const auto own = edge.distance_on_m.find(nodes.face_boundary_id[f]);
          own != edge.distance_on_m.end())
        for (const auto node : nodes.face(f))
          if (is_near[std::size_t(node)] != 0) come_nearer(std::size_t(node), edge, own->second);
  }
  return beyond_m;
}

bool is_left_out(const std::array<double, 3>& point, int boundary_id,
                 const std::vector<meshes::SharpEdge>& edges) {
  return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto own = edge.distance_on_m.find(boundary_id);
    const double on_surface_m = own == edge.distance_on_m.end() ? 0 : own->second;
    return distance_m(point, edge) <= within * std::max(edge.distance_m, on_surface_m);
  });
}

std::string to_string(Place place) {
  switch (place) {
    case Place::loaded_seat:
      return "under seat pressure";
    case Place::charged_wall:
      return "under the charge's pressure";
    case Place::free_surface:
      return "free surface";
    case Place::interior:
      return "interior";
  }
  throw std::logic_error("unknown place");
}

NodePlaces locate_nodes(const fem::Nodes& nodes, const std::vector<meshes::Feature>& features,
                        const std::vector<meshes::Port>& ports, const std::vector<meshes::SharpEdge>& edges,
                        const std::vector<std::string>& walls) {
  NodePlaces places;
  places.feature.assign(nodes.n, -1);
  places.place.assign(nodes.n, Place::interior);
  places.excluded.assign(nodes.n, 0);
  std::map<int, std::size_t> by_id;
  for (std::size_t f = 0; f < features.size(); ++f) {
    places.feature_names.push_back(features[f].name);
    by_id[features[f].boundary_id] = f;
  }
  for (std::size_t face = 0; face < nodes.n_faces(); ++face) {
    const std::size_t f = by_id.at(nodes.face_boundary_id[face]);
    for (const auto node : nodes.face(face)) {
      auto& current = places.feature[std::size_t(node)];
      if (current < 0 || precedence(features[f].kind) < precedence(features[std::size_t(current)].kind))
        current = std::int32_t(f);
    }
  }
  for (std::size_t i = 0; i < nodes.n; ++i) {
    if (places.feature[i] < 0) continue;
    const int id = features[std::size_t(places.feature[i])].boundary_id;
    const auto port = std::find_if(ports.begin(), ports.end(), [&](const auto& p) {
      return p.kind != meshes::Port::Kind::face && p.boundary_id == id;
    });
    places.place[i] = port == ports.end()                                                ? Place::free_surface
                      : std::find(walls.begin(), walls.end(), port->name) != walls.end() ? Place::charged_wall
                                                                                         : Place::loaded_seat;
  }
  for (const auto& edge : edges) exclude_around(nodes, edge, places);
  return places;
}

std::size_t peak_node(const std::vector<double>& value, const NodePlaces& places) {
  std::size_t peak = value.size();
  for (std::size_t i = 0; i < value.size(); ++i)
    if (!places.excluded[i] && (peak == value.size() || value[i] > value[peak])) peak = i;
  if (peak == value.size())
    throw StageRefused(
        "no place for a peak: what is left out around sharp edges covers the whole body; give a smaller "
        "exclusion in its table mesh");
  return peak;
}

std::string feature_at(const fem::Nodes& nodes, const NodePlaces& places, std::size_t node) {
  const std::int32_t feature =
      places.feature[node] >= 0 ? places.feature[node] : nearest_feature(nodes, places, node);
  return feature >= 0 ? places.feature_names[std::size_t(feature)] : std::string();
}

Zones find_zones(const fem::Nodes& nodes, const NodalMaximum& envelope, const NodePlaces& places,
                 double level_Pa, double yield_strength_Pa) {
  Zones result;
  result.level_Pa = level_Pa;
  result.zone_of_node.assign(nodes.n, 0);
  // A body without stress has no zones, whatever the level.
  const auto inside = [&](std::size_t i) {
    return is_in_zone(envelope.value_Pa[i], level_Pa, places.excluded[i] != 0);
  };
  DisjointSets sets = connected(nodes, inside);
  std::map<std::size_t, Zone> zones;  // by root
  for (std::size_t i = 0; i < nodes.n; ++i) {
    if (!inside(i)) continue;
    auto& zone = zones[sets.find(i)];
    if (zone.n_nodes == 0 || envelope.value_Pa[i] > zone.peak_Pa) {
      zone.peak_node = i;
      zone.peak_Pa = envelope.value_Pa[i];
    }
    zone.n_nodes += 1;
  }
  const auto volumes_m3 = fem::cell_volumes_above_m3(nodes, envelope.value_Pa, level_Pa, places.excluded);
  for_cells_of_regions(nodes, inside, volumes_m3, [&](std::size_t node, double volume_m3) {
    zones.at(sets.find(node)).volume_m3 += volume_m3;
  });
  std::vector<std::pair<std::size_t, Zone>> ranked(zones.begin(), zones.end());
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.second.peak_Pa > b.second.peak_Pa; });
  std::map<std::size_t, std::int32_t> rank;
  for (auto& [root, zone] : ranked) {
    const std::size_t node = zone.peak_node;
    std::copy_n(&nodes.xyz_m[3 * node], 3, zone.peak_m.begin());
    zone.instant = envelope.instant[node];
    zone.stress_Pa = envelope.stress_Pa[node];
    zone.safety = yield_strength_Pa / zone.peak_Pa;
    zone.place = places.place[node];
    zone.feature = feature_at(nodes, places, node);
    result.zones.push_back(zone);
    rank[root] = std::int32_t(result.zones.size());
  }
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (inside(i)) result.zone_of_node[i] = rank.at(sets.find(i));
  return result;
}

std::vector<double> region_volumes_m3(const fem::Nodes& nodes, const std::vector<double>& value,
                                      const NodePlaces& places, double level_Pa,
                                      const std::vector<std::size_t>& held) {
  const auto inside = [&](std::size_t i) { return is_in_zone(value[i], level_Pa, places.excluded[i] != 0); };
  DisjointSets sets = connected(nodes, inside);
  std::map<std::size_t, double> volume_m3;  // by root
  for_cells_of_regions(nodes, inside, fem::cell_volumes_above_m3(nodes, value, level_Pa, places.excluded),
                       [&](std::size_t node, double part_m3) { volume_m3[sets.find(node)] += part_m3; });
  std::vector<double> result;
  for (const auto node : held) result.push_back(inside(node) ? volume_m3[sets.find(node)] : 0);
  return result;
}

}  // namespace pipelines
