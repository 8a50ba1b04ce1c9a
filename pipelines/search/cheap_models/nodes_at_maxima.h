/// Nodes of a body of revolution at the largest stress of its places, which lies between the half planes and
/// between the points of the section. Internal to the runs on this model.
#pragma once

#include <vector>

#include "fem/base/values/unit_responses.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/loads/channels/channels.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

/// The nodes of a section turned around the axis, as fem::axisymmetric_responses leaves them, with what is
/// known of them.
struct RevolvedResults {
  fem::UnitResponses& responses;
  Envelope& envelope;
  NodePlaces& node_places;
  std::vector<PlaceStress>& places;
};

/// Moves one node of each place on the surface to where the place's largest stress lies: between half planes
/// by the trigonometric polynomial through the nodes of a circle, which is exact for harmonics below half of
/// `n_angles`; along the surface by the parabola through three circles, up to the border of what is left out
/// beside a sharp edge. Position, unit responses, envelope, and the places' values and nodes follow.
///
/// A node moves around the axis by less than the distance to the next one, and along the surface on to that
/// border alone: elsewhere it has the stress of a point at most half a distance of nodes away. Where it stood
/// is kept for the slopes in its cells (fem::Nodes::moved_from_m). Nodes where two surfaces meet know of the
/// stress around the axis alone. Places inside stay as they are.
/// @param n_angles  half planes
void move_nodes_to_maxima(const ChannelHistory& loads, const meshes::BodyMesh& mesh, int n_angles,
                          RevolvedResults results);

}  // namespace pipelines
