#include "pipelines/loads/body_loads.h"

#include <sstream>

#include "pipelines/common/errors.h"
#include "pipelines/scene/body_kind.h"

namespace pipelines {

LoadedBody loaded_body(const BodyScene& scene, const MeshedBody& meshed) {
  LoadedBody loaded{scene.name, meshed.mesh.ports, meshed.regions, scene.pressures};
  for (const auto& port : meshed.mesh.ports) {
    PressureModel usual;
    usual.highest_harmonic = scene.pressure_harmonics;
    loaded.pressures.try_emplace(port.name, usual);
  }
  return loaded;
}

BodyLoads distribute_body(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                          const LoadedBody& loaded, const MassAgreement& masses) {
  return kind_of(body).distribute(scene, body, history, loaded, masses);
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
