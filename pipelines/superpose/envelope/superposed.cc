#include "pipelines/superpose/envelope/superposed.h"

#include <utility>

#include "pipelines/superpose/envelope/finite_stress.h"

namespace pipelines {
namespace {

/// The ports that a mill's charge presses on.
std::vector<std::string> walls_under_charge(const Responded& responded) {
  std::vector<std::string> walls;
  for (const auto& port : responded.mesh.ports)
    if (usual_pressure(responded.scene, port.name).is_charge) walls.push_back(port.name);
  return walls;
}

}  // namespace

Superposed superpose(Responded responded, int n_threads, StageClock& clock, std::optional<Envelope> known) {
  Superposed result(std::move(responded));
  require_finite(result.responses);
  result.closure = check_closure(result.loads, result.responses.resultants, result.regions);
  require_closure(result.scene.name, result.closure);
  clock.run("superpose", [&] {
    result.envelope = known ? std::move(*known) : envelope(result.loads.history, result.responses, n_threads);
  });
  require_finite(result.scene.name, result.envelope);
  clock.run("zones", [&] {
    result.places = locate_nodes(result.responses.nodes, result.mesh.features, result.mesh.ports,
                                 result.mesh.sharp_edges, walls_under_charge(result));
  });
  return result;
}

}  // namespace pipelines
