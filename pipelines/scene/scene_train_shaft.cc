#include <algorithm>

#include "pipelines/common/name_lists.h"
#include "pipelines/common/nearest_name.h"
#include "pipelines/scene/scene_body_parts.h"

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
  table.know("forces");
  if (table.has("forces"))
    for (SceneTable& entry : table.tables("forces")) {
      TrainShaftOptions::Force force;
      force.effect = entry.text("effect");
      force.port = entry.text("port");
      const auto is_excitation = [&](const auto& excitation) { return excitation.name == force.effect; };
      if (force.effect == "shaft_inertia" ||
          std::any_of(train.excitations.begin(), train.excitations.end(), is_excitation))
        entry.refuse("effect", "is the name of another effect of this scene; take a name of its own");
      const auto value = entry.quantities("force", "N", between(-1e9, 1e9), 3);
      if (value.size() == 3) force.force_N = {value[0], value[1], value[2]};
      force.turns_with_shaft = entry.flag_or("turns_with_shaft", false, "it stands still in space");
      entry.finish();
      shaft.forces.push_back(force);
    }
}

}  // namespace

void read_train_shaft(SceneTable& table, const kinetics::DriveTrain& train, BodyScene& body) {
  auto& shaft = body.train;
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
}

}  // namespace pipelines
