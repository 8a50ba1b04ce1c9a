#include "pipelines/loads/bodies/train_shaft.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/loads/stage/mass_comparison.h"
#include "pipelines/scene/bodies/scene_body.h"
#include "pipelines/scene/bodies/scene_body_parts.h"
#include "pipelines/scene/values/effect_names.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

/// @return whether the train has it, and it turns freely
bool read_inertia(SceneTable& table, const kinetics::DriveTrain& train, TrainShaftOptions& shaft) {
  shaft.inertia = table.text("inertia");
  std::vector<std::string> names;
  for (const auto& inertia : train.inertias) {
    names.push_back(inertia.name);
    if (inertia.name == shaft.inertia && inertia.held)
      table.refuse("inertia",
                   "is held, by something that is no load of this shaft, so that nothing would balance; name "
                   "one that turns freely");
  }
  const bool is_known = contains(names, shaft.inertia);
  if (!is_known && !shaft.inertia.empty())
    table.refuse("inertia", "the train has no such inertia; it has " + listed(names));
  return is_known;
}

/// Every element on the inertia enters once.
void read_torques(SceneTable& table, const kinetics::DriveTrain& train, bool inertia_is_known,
                  TrainShaftOptions& shaft) {
  std::vector<std::string> elements, entered;
  for (const auto& element : train.elements)
    if (element.first == shaft.inertia || element.second == shaft.inertia) elements.push_back(element.name);
  bool all_known = inertia_is_known && table.has("torques");
  for (SceneTable& entry : table.tables("torques")) {
    const std::string port = entry.text("port"), element = entry.text("element");
    const bool is_known = contains(elements, element);
    if (inertia_is_known && !is_known && !element.empty())
      entry.refuse("element", "does not join \"" + shaft.inertia + "\" to anything; its elements are " +
                                  listed(elements));
    if (is_known && contains(entered, element))
      entry.refuse("element", "enters twice; its torque belongs to one port");
    all_known = all_known && is_known;
    shaft.torques.push_back({port, element + "_on_" + shaft.inertia});
    entered.push_back(element);
    entry.finish();
  }
  for (const auto& element : elements)
    if (all_known && !contains(entered, element))
      table.refuse("torques",
                   "the torque of \"" + element + "\" enters nowhere, so that nothing would balance; add it");
}

void read_forces(SceneTable& table, const kinetics::DriveTrain& train, TrainShaftOptions& shaft) {
  table.know("forces");
  if (table.has("forces"))
    for (SceneTable& entry : table.tables("forces")) {
      GivenForce force;
      force.effect = entry.name("effect");
      force.port = entry.text("port");
      const auto is_excitation = [&](const auto& excitation) { return excitation.name == force.effect; };
      if (force.effect == effect_name::shaft_inertia ||
          std::any_of(train.excitations.begin(), train.excitations.end(), is_excitation))
        entry.refuse("effect", "is the name of another effect of this scene; take a name of its own");
      const auto value = entry.quantities("force", "N", between(-1e9, 1e9), 3);
      if (value.size() == 3) force.force_N = {value[0], value[1], value[2]};
      force.turns_with_shaft = entry.flag_or("turns_with_shaft", false, "it stands still in space");
      entry.finish();
      shaft.forces.push_back(force);
    }
}

/// A torque that is not the same at every instant, so that the train vibrates.
bool varies(const kinetics::TrainExcitation& excitation) {
  const auto& samples = excitation.table.torque_Nm;
  return std::any_of(excitation.harmonics.begin(), excitation.harmonics.end(),
                     [](const auto& harmonic) { return harmonic.amplitude_Nm != 0; }) ||
         std::any_of(samples.begin(), samples.end(), [&](double torque) { return torque != samples[0]; });
}

const TrainShaftOptions& train_options(const BodyScene& body) {
  return std::get<TrainShaftOptions>(body.options);
}

double mean_speed_of(const Scene& scene, const BodyScene& body) {
  return kinetics::mean_speed_rad_s(std::get<kinetics::DriveTrain>(scene.machine),
                                    train_options(body).inertia);
}

class TrainShaftKind : public BodyKind {
public:
  std::string machine_type() const override { return "drive_train"; }
  std::vector<std::string> tables() const override { return {"shaft"}; }

  BodyOptions read_options(SceneTable& table, const Scene& scene) const override {
    const auto& train = std::get<kinetics::DriveTrain>(scene.machine);
    TrainShaftOptions shaft;
    const bool inertia_is_known = read_inertia(table, train, shaft);
    read_torques(table, train, inertia_is_known, shaft);
    table.know("bearings");
    if (table.has("bearings")) {
      const auto names = table.texts("bearings");
      if (names.size() != 2 || names[0].text == names[1].text)
        table.refuse("bearings", "needs the ports of two bearings");
      else
        shaft.bearings = {names[0].text, names[1].text};
    }
    shaft.axial_bearing = table.text_or("axial_bearing", shaft.bearings[0], "takes forces along the shaft");
    read_forces(table, train, shaft);
    return shaft;
  }
  ContourRules contour_rules(const Scene&, const BodyScene& body) const override {
    const auto& shaft = train_options(body);
    ContourRules rules;
    rules.any_port = true;
    rules.ports = {shaft.bearings[0], shaft.bearings[1]};
    for (const auto& torque : shaft.torques) rules.ports.push_back(torque.port);
    for (const auto& force : shaft.forces) rules.ports.push_back(force.port);
    return rules;
  }
  void check_ports(SceneTable& table, const BodyScene& body) const override {
    check_port(table, "axial_bearing", train_options(body).axial_bearing, ports_of(body).all,
               "the ports of this body");
  }
  std::vector<std::string> bearing_loads(const BodyScene& body) const override {
    return train_options(body).forces.empty() ? std::vector<std::string>{} : supporting_ports(body);
  }
  std::optional<double> seat_speed_rad_s(const Scene& scene, const BodyScene& body) const override {
    return mean_speed_of(scene, body);
  }
  std::vector<kinetics::EffectInfo> own_effects() const override {
    return {{effect_name::shaft_inertia, "Angular inertia of the shaft itself, -J phi'', from its mesh.",
             "coupling 6"}};
  }
  /// The shaft's own effects, then the forces that the scene puts on it, each effect once.
  std::vector<kinetics::EffectInfo> effects(const BodyScene& body) const override {
    auto table = own_effects();
    for (const auto& force : train_options(body).forces)
      if (std::none_of(table.begin() + 1, table.end(),
                       [&](const auto& info) { return info.name == force.effect; }))
        table.push_back({force.effect, "Force on the shaft beside the train's torques.", "the user's"});
    return table;
  }
  std::vector<GivenForce> given_forces(const BodyScene& body) const override {
    return train_options(body).forces;
  }
  /// What the balance T_34 - T_45 - D phi' = J phi'' of a train's shaft needs; a start accelerates it
  /// whatever the torques of steady running do.
  void add_needs(const Scene& scene, std::vector<kinetics::EffectInfo>& table) const override {
    const bool starts = scene.torsion.transient.has_value();
    const kinetics::EffectNeed inertia{
        effect_name::shaft_inertia,
        std::string(starts ? "[machine.transient]" : "its torque") +
            " accelerates the shaft, and nothing but the shaft's inertia balances that",
        "coupling 6, T_34 - T_45 - D_4 phi_4' = J_4 phi_4''"};
    for (const auto& excitation : std::get<kinetics::DriveTrain>(scene.machine).excitations)
      for (auto& info : table)
        if (info.name == excitation.name && (starts || varies(excitation))) info.needs.push_back(inertia);
  }
  bool shares_masses() const override { return true; }
  std::optional<std::string> usual_difference_port(const BodyScene& body) const override {
    const auto& torques = train_options(body).torques;
    return torques.empty() ? std::nullopt : std::optional(torques.front().port);
  }
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
  void report(const Scene& scene, const BodyScene& body, const BodyLoads&,
              kinetics::LoadHistory& history) const override {
    const auto& forces = train_options(body).forces;
    if (std::none_of(forces.begin(), forces.end(),
                     [&](const auto& force) { return scene.has_effect(force.effect); }))
      history.warnings.push_back("a drive train gives torsion only: bending is not modelled");
  }
  std::vector<std::string> supporting_ports(const BodyScene& body) const override {
    const auto& bearings = train_options(body).bearings;
    return {bearings[0], bearings[1]};
  }
  double spin_Hz(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory&) const override {
    return std::abs(mean_speed_of(scene, body)) / (2 * pi);
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

const BodyKind& train_shaft_kind() {
  static const TrainShaftKind kind;
  return kind;
}

}  // namespace pipelines
