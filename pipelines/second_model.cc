#include "pipelines/second_model.h"

#include <algorithm>
#include <cmath>

#include "pipelines/cheap_rungs.h"
#include "pipelines/fineness.h"
#include "pipelines/place_stress.h"
#include "pipelines/refinement.h"
#include "pipelines/superposition.h"

namespace pipelines {
namespace {

/// A peak of m = 1 between two of 48 nodes around: 1 - cos(pi / 48).
constexpr double between_angles = 2.2e-3;

std::vector<PlaceStress> places_on(const BodyScene& section, const MeshedBody& meshed, const BodyLoads& loads,
                                   int n_threads, double& model_error) {
  const auto model = axisymmetric_responses(section, meshed.mesh, loads.unit_loads).value();
  model_error = model.model_error;
  const auto maximum = envelope(loads.history, model.responses, std::max(1, n_threads));
  const auto& nodes = model.responses.nodes;
  return largest_by_feature(
      nodes, maximum.von_mises.value_Pa, meshed.mesh.features,
      locate_nodes(nodes, meshed.mesh.features, meshed.mesh.ports, meshed.mesh.sharp_edges));
}

}  // namespace

std::optional<SecondModel> axisymmetric_second_model(const BodyScene& body, const MeshedBody& meshed,
                                                     const BodyLoads& loads, int n_threads) {
  if (!is_block_shaft(body)) return std::nullopt;
  BodyScene section = body;
  std::get<ShaftShape>(section.shape).mesh = {};
  SecondModel result;
  const auto coarse = places_on(section, meshed, loads, n_threads, result.model_error);
  result.places = places_on(with_fineness(section, 2), meshed, loads, n_threads, result.model_error);
  for (auto& place : result.places) {
    const bool is_fillet = place.feature.rfind("fillet ", 0) == 0;
    for (const auto& other : coarse)
      if (other.feature == place.feature)
        place.error_Pa = std::abs(place.value_Pa - other.value_Pa) / (is_fillet ? 3 : 1) +
                         between_angles * place.value_Pa;
  }
  return result;
}

}  // namespace pipelines
