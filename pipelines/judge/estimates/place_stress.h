/// The places of a body that may hold its largest stress, each with its own value and error. A promise about
/// the body's largest stress is one about all of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

/// The largest von Mises stress over the cycle on one feature of the surface ("fillet a/b", "seat", ...),
/// inside the body, or at a weld toe.
struct PlaceStress {
  std::string feature;   ///< name of the feature, of the weld toe, or "inside"
  std::size_t node = 0;  ///< node of the maximum; at a weld toe its nearer reference point
  double value_Pa = 0;
  double error_Pa = 0;  ///< numerical, for want of a finer mesh
  std::array<double, 3> position_m{};
  bool is_resolved = false;   ///< the error is that of submodels: no margin to give away
  double least_error_Pa = 0;  ///< for want of cells, however well coarse meshes agree
  /// A fillet that was meshed with cells_that_converge: one mesh tells its error.
  bool has_fine_cells = false;
};

inline constexpr const char* inside_the_body = "inside";
/// Share of the largest stress on the surface below which a maximum inside is no place of its own: it is that
/// of the node next to the surface, and says where nodes lie. An extremum inside (a shaft that spins, the
/// depth below a pressed seat) is one of the largest.
inline constexpr double share_of_inside = 0.9;

/// The largest value of each feature outside the exclusion distances, errors zero. A node on the seam of two
/// features belongs to both: else the maximum of a cylinder beside a fillet would be that of the first node
/// off the seam, and depend on where that lies. Features without a node outside the exclusion distances have
/// no entry; nodes on no surface are "inside", which has an
/// entry where it may govern: from nine tenths of the surface's largest value.
std::vector<PlaceStress> largest_by_feature(const fem::Nodes& nodes, const std::vector<double>& von_mises_Pa,
                                            const std::vector<meshes::Feature>& features,
                                            const NodePlaces& places);

/// What the places say together.
struct PlaceJudgement {
  std::size_t governing = 0;     ///< index of the largest value
  std::size_t holding_back = 0;  ///< index of the place that keeps the error of the whole largest
  /// Stress by which another place, with its error, exceeds the governing one with its.
  double other_places_Pa = 0;
  std::string other_place;  ///< that place; empty if other_places_Pa is zero
};

/// The true maximum of the body lies between the governing value less its error and the largest sum of value
/// and error of all places.
/// @param places  not empty
PlaceJudgement judge(const std::vector<PlaceStress>& places);

}  // namespace pipelines
