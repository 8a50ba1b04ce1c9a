#include "pipelines/loads/body_loads.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "pipelines/common/errors.h"
#include "pipelines/loads/distribute.h"

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
  const auto& attached = masses.attached.at(body.name);
  switch (body.role) {
    case BodyRole::vibratory_shaft: {
      VibratoryShaftOptions options;
      options.gravity_m_s2 = scene.vibratory_mill().gravity_m_s2;
      options.own_weight = scene.has_effect("gravity_shaft");
      options.own_inertia = scene.has_effect("shaft_inertia");
      options.debalance_shares = {body.debalance_shares.at(0), body.debalance_shares.at(1)};
      return distribute_vibratory_shaft(history, loaded, options);
    }
    case BodyRole::chamber:
      return distribute_chamber(history, std::get<kinetics::VibratoryMill>(masses.machine), loaded,
                                {scene.effects, attached.structure, attached.exciter, body.pitch_guide});
    case BodyRole::drum:
      return distribute_drum(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                             {scene.effects, attached.structure});
    case BodyRole::stub_axle: {
      auto options = body.stub_axle;
      options.effects = scene.effects;
      return distribute_stub_axle(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                                  options);
    }
    case BodyRole::train_shaft: {
      const auto& train = std::get<kinetics::DriveTrain>(masses.machine);
      auto options = body.train;
      options.effects = scene.effects;
      options.attached = attached.structure;
      options.forces.erase(std::remove_if(options.forces.begin(), options.forces.end(),
                                          [&](const auto& force) { return !scene.has_effect(force.effect); }),
                           options.forces.end());
      return distribute_train_shaft(history, kinetics::mean_speed_rad_s(train, options.inertia), loaded,
                                    options);
    }
    case BodyRole::table_body:
      return distribute_table(std::get<kinetics::LoadTable>(scene.machine), scene.effects, scene.sampling,
                              loaded, body.table);
  }
  throw std::logic_error("unknown role of a body");
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
