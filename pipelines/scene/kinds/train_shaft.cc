#include <algorithm>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/bodies/scene_body_parts.h"
#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {
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
  for (SceneTable& entry : table.tables_if_any("forces")) {
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

class TrainShaftReader : public BodyReader {
public:
  std::string machine_type() const override { return "drive_train"; }
  std::vector<std::string> tables() const override { return {"shaft"}; }
  BodyOptions read_options(SceneTable& table, const Scene& scene) const override {
    const auto& train = std::get<kinetics::DriveTrain>(scene.machine);
    TrainShaftOptions shaft;
    const bool inertia_is_known = read_inertia(table, train, shaft);
    read_torques(table, train, inertia_is_known, shaft);
    if (table.is_given("bearings")) {
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
    return kinetics::mean_speed_rad_s(std::get<kinetics::DriveTrain>(scene.machine),
                                      train_options(body).inertia);
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
  std::vector<std::string> supporting_ports(const BodyScene& body) const override {
    const auto& bearings = train_options(body).bearings;
    return {bearings[0], bearings[1]};
  }
};

}  // namespace

const BodyReader& train_shaft_reader() {
  static const TrainShaftReader reader;
  return reader;
}

}  // namespace pipelines
