#include "pipelines/loads/bodies/drum.h"

#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/bodies/planetary_fields.h"
#include "pipelines/loads/stage/mass_comparison.h"
#include "pipelines/scene/kinds/body_names.h"
#include "pipelines/scene/values/effect_names.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

class DrumLoads : public LoadMaker {
public:
  void agree_masses(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    MassAgreement& result) const override {
    auto& mill = std::get<kinetics::PlanetaryMill>(result.machine);
    auto& attached = result.attached[body.name].structure;
    attached = added_masses(body, meshed.mesh, "");
    PlanarMass drum = planar_mass(meshed.masses);
    drum += planar_mass(attached);
    const bool open = is_open(scene, "drum");
    if (open) mill.drum_mass_kg = drum.mass_kg;
    MassComparison comparison(body, result.figures);
    PlanarMass rest;
    rest.mass_kg =
        comparison.compare("drum mass", "kg", mill.drum_mass_kg, drum.mass_kg, open, body.difference_port);
    comparison.compare_centre("drum first moment", drum, body.difference_port,
                              "the drum's centre is on its axis: balance it by another added mass");
    rest.x_kg_m = -drum.x_kg_m;  // the load stage has its centre on the axis
    rest.y_kg_m = -drum.y_kg_m;
    add_difference(attached, body.difference_port, rest);
  }
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement& masses) const override {
    return distribute_drum(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                           {scene.effects, masses.attached.at(body.name).structure});
  }
  double spin_Hz(const Scene&, const BodyScene&, const kinetics::LoadHistory& loads) const override {
    return std::abs(loads.quantity("drum_relative_speed").values.mean()) / (2 * pi);
  }
};

}  // namespace

BodyLoads distribute_drum(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                          const LoadedBody& body, const DrumLoading& loading) {
  planetary::require_equilibrium(loads);
  const ArrayXd& psi = loads.quantity("psi").values;
  LoadCollector collector(body, loads.effects, loads.n_instants(), planetary::typical_force(loads));
  const auto enter = [&](const std::string& role, const std::string& port) {
    if (!loads.has_resultant(role)) return;
    for (const auto& part : loads.resultant(role).contributions) {
      collector.force(port, part.effect, turned(part.load.topRows<2>(), psi));
      collector.torque(port, part.effect, part.load.row(2).transpose());
    }
  };
  enter("inner_wall", DrumNames::wall);
  enter("pulley", DrumNames::pulley);

  const auto accelerate = [&](const std::string& name, const AccelerationField& field) {
    if (!contains(loading.effects, name)) return;
    const auto effect = collector.effect(name);
    collector.accelerate(body.region(), effect, field);
    for (const auto& mass : loading.attached) collector.accelerate(mass, effect, field);
  };
  accelerate(effect_name::drum_transport,
             planetary::translation(turned(planetary::transport(loads, mill), psi)));
  accelerate(effect_name::drum_gravity,
             planetary::translation(turned(planetary::gravity(loads, mill.gravity_m_s2), psi)));
  accelerate(DrumNames::spin, {{}, {}, loads.quantity("drum_speed").values.square()});

  std::map<std::size_t, Array2Xd> reaction;
  for (const auto& part : loads.resultant("trunnions").contributions)
    reaction[part.effect] = turned(part.load.topRows<2>(), psi);
  collector.react(DrumNames::trunnion_1, DrumNames::trunnion_2, reaction);
  for (const char* port : {DrumNames::wall, DrumNames::pulley, DrumNames::trunnion_1, DrumNames::trunnion_2})
    collector.pressure(port);
  return collector.finish();
}

const LoadMaker& drum_loads() {
  static const DrumLoads loads;
  return loads;
}

}  // namespace pipelines
