/// Stress zones: connected regions of a body where the envelope exceeds a level, ranked by their peak.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {

/// Whether a node lies under a load, on free surface, or inside the body. The charge of a mill presses on a
/// wall, a ring or a pin on a seat.
enum class Place { loaded_seat, charged_wall, free_surface, interior };
/// "under seat pressure", "under the charge's pressure", "free surface", "interior"
std::string to_string(Place place);

/// Where each node of a body lies, from the features of its mesh.
struct NodePlaces {
  std::vector<std::string> feature_names;
  /// Per node: the feature it lies on (fillets before seats before others), -1 inside.
  std::vector<std::int32_t> feature;
  std::vector<Place> place;    ///< per node
  std::vector<char> excluded;  ///< per node: within the exclusion distance of a sharp re-entrant edge
};

/// @param walls  names of the ports that a mill's charge presses on
NodePlaces locate_nodes(const fem::Nodes& nodes, const std::vector<meshes::Feature>& features,
                        const std::vector<meshes::Port>& ports, const std::vector<meshes::SharpEdge>& edges,
                        const std::vector<std::string>& walls = {});

/// The feature that a node lies on, or of an interior one the nearest; empty if the body has none.
std::string feature_at(const fem::Nodes& nodes, const NodePlaces& places, std::size_t node);

/// Whether a point of a surface is within the exclusion distance of an edge, as `excluded` of nodes.
bool is_left_out(const std::array<double, 3>& point, int boundary_id,
                 const std::vector<meshes::SharpEdge>& edges);

/// Distance of every node from the border of what is left out, negative within; exact of nodes in cells that
/// the border passes through and within, elsewhere the largest exclusion distance. Empty where nothing is
/// left out.
std::vector<double> beyond_left_out_m(const fem::Nodes& nodes, const NodePlaces& places,
                                      const std::vector<meshes::SharpEdge>& edges);

/// Distance from a point to the nearest of the edge's pieces.
double distance_m(const std::array<double, 3>& point, const meshes::SharpEdge& edge);

/// A connected region within a zone where the envelope is above a higher level (zone_parts.h).
struct ZonePart {
  std::string number;        ///< "1.2" in zone 1, "1.2.1" in that; siblings by descending peak
  double level_Pa = 0;       ///< nodes of the part are at or above it
  double share_of_peak = 0;  ///< the level as a share of the body's peak
  std::size_t peak_node = 0;
  double peak_Pa = 0;
  std::array<double, 3> peak_m{};
  std::int32_t instant = 0;  ///< instant of the peak
  std::size_t n_nodes = 0;
  std::string feature;            ///< the nearest feature or port
  Place place = Place::interior;  ///< place of the peak
};

struct Zone {
  std::size_t peak_node = 0;
  double peak_Pa = 0;
  std::array<double, 3> peak_m{};
  std::int32_t instant = 0;        ///< instant of the peak
  Stress stress_Pa{};              ///< tensor at the peak and instant
  double safety = 0;               ///< yield strength / peak
  std::optional<double> error_Pa;  ///< numerical error of the peak; none: not estimated
  double volume_m3 = 0;
  /// Numerical error of the volume (zone_volume_errors.h); none: not estimated.
  std::optional<double> volume_error_m3;
  std::size_t n_nodes = 0;
  std::string feature;            ///< the nearest feature or port
  Place place = Place::interior;  ///< place of the peak
  std::vector<ZonePart> parts;    ///< every part before those within it; none until zones are divided
};

/// How many of a body's zones the terminal shows, with errors.
inline constexpr std::size_t n_zones_shown = 10;

struct Zones {
  double level_Pa = 0;
  std::vector<Zone> zones;                 ///< descending peak
  std::vector<std::int32_t> zone_of_node;  ///< 1-based rank, 0 outside all zones
};

/// The node with the largest value outside the excluded ones; lowest index among equals.
/// @throws StageRefused if every node is excluded
std::size_t peak_node(const std::vector<double>& value, const NodePlaces& places);

/// Nodes at or above the level, connected when they share a cell. The volume is that of the region where the
/// envelope, linear between neighbouring nodes, is above the level (fem/stress/cells/region_volume.h).
/// Excluded nodes and their share of the cells belong to no zone.
Zones find_zones(const fem::Nodes& nodes, const NodalMaximum& envelope, const NodePlaces& places,
                 double level_Pa, double yield_strength_Pa);

/// Whether a node with this value belongs to a zone above the level.
inline bool is_in_zone(double value_Pa, double level_Pa, bool is_excluded) {
  return value_Pa > 0 && value_Pa >= level_Pa && !is_excluded;
}

/// Volumes of the connected regions above the level, as find_zones measures them, that hold some nodes.
/// @param value  one per node [Pa]
/// @param held   the nodes
/// @return one per entry of `held` [m^3]; 0 of a node below the level or excluded
std::vector<double> region_volumes_m3(const fem::Nodes& nodes, const std::vector<double>& value,
                                      const NodePlaces& places, double level_Pa,
                                      const std::vector<std::size_t>& held);

}  // namespace pipelines
