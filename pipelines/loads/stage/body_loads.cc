#include "pipelines/loads/stage/body_loads.h"

#include <optional>
#include <sstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/loads/stage/load_maker.h"

namespace pipelines {

namespace {

/// PressureModel::ring_factor; nothing where the body's shape does not tell.
std::optional<double> ring_factor(const BodyScene& scene, const meshes::Port& port) {
  const auto* shaft = scene.shaft();
  if (shaft == nullptr || port.kind != meshes::Port::Kind::seat) return std::nullopt;
  const double middle_m = (port.begin_m + port.end_m) / 2;
  for (const auto& segment : shaft->geometry.segments)
    if (segment.begin_m <= middle_m && middle_m <= segment.end_m && segment.bore_m > 0)
      return (segment.diameter_m + segment.bore_m) / (segment.diameter_m - segment.bore_m);
  return 1;
}

}  // namespace

LoadedBody loaded_body(const BodyScene& scene, const MeshedBody& meshed) {
  const double nu = scene.material.poisson_ratio;
  LoadedBody loaded{
      scene.name, meshed.mesh.ports, meshed.regions, {}, scene.material.youngs_modulus_Pa / (1 - nu * nu)};
  for (const auto& port : meshed.mesh.ports) {
    const auto own = scene.pressures.find(port.name);
    PressureModel model = own != scene.pressures.end() ? own->second : usual_pressure(scene, port.name);
    const auto factor = ring_factor(scene, port);
    model.ring_factor = factor.value_or(1);
    // Without the second harmonic nothing tells how much a wall of unknown thickness bends.
    model.solves_missing = scene.felt_seats.count(port.name) > 0 || (model.highest_harmonic < 2 && !factor);
    loaded.pressures.emplace(port.name, std::move(model));
  }
  return loaded;
}

BodyLoads distribute_body(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                          const LoadedBody& loaded, const MassAgreement& masses) {
  return load_maker_of(body).distribute(scene, body, history, loaded, masses);
}

void require_closure(const std::string& body, const Closure& closure) {
  if (closure.holds()) return;
  std::ostringstream text;
  text << "the loads on the " << body << " do not close on the mesh: forces to " << closure.worst_force()
       << ", moments to " << closure.worst_moment() << ", channels to " << closure.channel_resultant
       << " of their scale; " << Closure::limit
       << " is required. The scene's effects leave a resultant that nothing carries";
  throw LoadsDoNotClose(text.str());
}

void require_closed_loads(const BodyLoads& loads, const std::vector<RegionMass>& regions) {
  if (loads.unit_loads.empty())
    throw StageRefused("no effect of the scene loads the " + loads.history.body +
                       "; name one that does, or remove [" + loads.history.body + "]");
  std::vector<std::array<double, 6>> wanted;
  for (const auto& load : loads.unit_loads) wanted.push_back(wanted_resultant(load, regions));
  require_closure(loads.history.body, check_closure(loads, wanted, regions));
}

}  // namespace pipelines
