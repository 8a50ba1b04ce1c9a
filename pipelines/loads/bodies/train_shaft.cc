#include "pipelines/loads/bodies/train_shaft.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/loads/stage/mass_comparison.h"
#include "pipelines/scene/values/effect_names.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

const TrainShaftOptions& train_options(const BodyScene& body) {
  return std::get<TrainShaftOptions>(body.options);
}

class TrainShaftLoads : public LoadMaker {
public:
  void agree_masses(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                    MassAgreement& result) const override {
    auto& train = std::get<kinetics::DriveTrain>(result.machine);
    auto& attached = result.attached[body.name].structure;
    attached = added_masses(body, meshed.mesh, "");
    PlanarMass shaft = planar_mass(meshed.masses);
    shaft += planar_mass(attached);
    const auto inertia = std::find_if(train.inertias.begin(), train.inertias.end(),
                                      [&](const auto& i) { return i.name == train_options(body).inertia; });
    if (inertia == train.inertias.end())
      throw StageRefused("shaft.inertia = \"" + train_options(body).inertia +
                         "\": the train has no such inertia");
    const bool open = is_open(scene, inertia->name);
    if (open) inertia->inertia_kg_m2 = shaft.polar_kg_m2;
    MassComparison comparison(body, result.figures);
    PlanarMass rest;
    rest.polar_kg_m2 = comparison.compare("inertia of " + inertia->name, "kg m2", inertia->inertia_kg_m2,
                                          shaft.polar_kg_m2, open, body.difference_port);
    // What of the inertia's force field a shaft out of centre leaves is no part of a torsional train.
    rest.x_kg_m = -shaft.x_kg_m;
    rest.y_kg_m = -shaft.y_kg_m;
    add_difference(attached, body.difference_port, rest);
  }
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement& masses) const override {
    const auto& train = std::get<kinetics::DriveTrain>(masses.machine);
    TrainShaftOptions options = train_options(body);
    auto& forces = options.forces;
    forces.erase(std::remove_if(forces.begin(), forces.end(),
                                [&](const auto& force) { return !scene.has_effect(force.effect); }),
                 forces.end());
    return distribute_train_shaft(history, kinetics::mean_speed_rad_s(train, options.inertia), loaded,
                                  options, scene.effects, masses.attached.at(body.name).structure);
  }
  std::vector<ElementPort> element_ports(const BodyScene& body) const override {
    const auto& shaft = train_options(body);
    std::vector<ElementPort> ports;
    for (const auto& torque : shaft.torques)
      ports.push_back({torque.role.substr(0, torque.role.size() - ("_on_" + shaft.inertia).size()),
                       torque.port, torque.role});
    return ports;
  }
  std::string warning(const Scene& scene, const BodyScene& body, const BodyLoads&) const override {
    const auto& forces = train_options(body).forces;
    const bool bends = std::any_of(forces.begin(), forces.end(),
                                   [&](const auto& force) { return scene.has_effect(force.effect); });
    return bends ? "" : "a drive train gives torsion only: bending is not modelled";
  }
  double spin_Hz(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory&) const override {
    return std::abs(kinetics::mean_speed_rad_s(std::get<kinetics::DriveTrain>(scene.machine),
                                               train_options(body).inertia)) /
           (2 * pi);
  }
  int turning(const Scene& scene, const BodyScene& body) const override {
    return kinetics::mean_speed_rad_s(std::get<kinetics::DriveTrain>(scene.machine),
                                      train_options(body).inertia) < 0
               ? -1
               : 1;
  }
};

}  // namespace

BodyLoads distribute_train_shaft(const kinetics::LoadHistory& loads, double mean_speed_rad_s,
                                 const LoadedBody& body, const TrainShaftOptions& options,
                                 const std::vector<std::string>& effects,
                                 const std::vector<AttachedMass>& attached) {
  const Index n = loads.n_instants();
  const auto torque_of = [&](const std::string& role) -> const kinetics::Resultant& {
    return loads.resultant(role);
  };
  double largest_torque = 0, smallest_radius = 1e300;
  for (const auto& torque : options.torques)
    largest_torque = std::max(largest_torque, torque_of(torque.role).total.row(2).abs().maxCoeff());
  for (const auto& port : body.ports)
    if (port.radius_m > 0) smallest_radius = std::min(smallest_radius, port.radius_m);
  LoadCollector collector(body, loads.effects, n, std::max(largest_torque / smallest_radius, 1e-300));

  for (const auto& torque : options.torques)
    for (const auto& part : torque_of(torque.role).contributions)
      collector.torque(torque.port, part.effect, part.load.row(2).transpose());
  for (const std::string prefix : {"excitation_on_", "damping_on_"})
    if (const std::string role = prefix + options.inertia; loads.has_resultant(role))
      for (const auto& part : loads.resultant(role).contributions)
        for (const auto& bearing : options.bearings)
          collector.torque(bearing, part.effect, part.load.row(2).transpose() / 2);

  if (contains(effects, effect_name::shaft_inertia)) {
    const AccelerationField field{{}, -loads.quantity(options.inertia + ".acceleration").values, {}};
    const auto effect = collector.effect(effect_name::shaft_inertia);
    collector.accelerate(body.region(), effect, field);
    for (const auto& mass : attached) collector.accelerate(mass, effect, field);
  }

  // Across and along: only what the scene asks for beyond torsion.
  const ArrayXd angle = mean_speed_rad_s * loads.time_s + loads.quantity(options.inertia + ".angle").values;
  for (const auto& force : options.forces) {
    const auto effect = collector.effect(force.effect);
    Array2Xd across(2, n);
    for (Index d = 0; d < 2; ++d) across.row(d) = force.force_N[std::size_t(d)];
    if (!force.turns_with_shaft) across = turned(across, angle);
    if (across.abs().maxCoeff() > 0) collector.force(force.port, effect, across);
    if (force.force_N[2] != 0)
      collector.axial_force(force.port, effect, ArrayXd::Constant(n, force.force_N[2]));
  }
  if (!options.forces.empty()) {
    // Axial forces are balanced first: off the axis of an eccentric port, one tilts the shaft, which the
    // bearings then carry.
    if (!options.axial_bearing.empty()) collector.react_axial(options.axial_bearing);
    collector.react(options.bearings[0], options.bearings[1]);
    for (const auto& port : body.ports) collector.pressure(port.name);
  }
  return collector.finish();
}

const LoadMaker& train_shaft_loads() {
  static const TrainShaftLoads loads;
  return loads;
}

}  // namespace pipelines
