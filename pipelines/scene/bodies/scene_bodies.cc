#include <algorithm>
#include <utility>

#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/bodies/scene_body.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

/// Tables of bodies, and what they are there.
using BodyTables = std::vector<std::pair<std::string, const BodyReader*>>;

/// Tables of the bodies of all machines; a name that several kinds have once.
BodyTables all_bodies() {
  BodyTables all;
  for (const auto* kind : body_readers())
    for (const auto& name : kind->tables())
      if (std::none_of(all.begin(), all.end(), [&](const auto& known) { return known.first == name; }))
        all.emplace_back(name, kind);
  return all;
}

BodyTables bodies_of(const std::string& machine_type) {
  BodyTables own;
  for (const auto* kind : body_readers())
    if (kind->machine_type() == machine_type)
      for (const auto& name : kind->tables()) own.emplace_back(name, kind);
  return own;
}

}  // namespace

std::vector<SceneTable> read_bodies(SceneTable& root, Scene& scene, SceneFindings& findings) {
  const MachineKind& machine = kind_of(scene.machine);
  std::vector<SceneTable> tables;
  const BodyTables own = bodies_of(machine.type());
  for (const auto& [name, kind] : own) {
    if (!root.is_given(name)) continue;
    tables.push_back(root.table(name));
    scene.bodies.push_back(read_body(tables.back(), *kind, scene, findings));
  }
  for (const auto& [name, kind] : all_bodies()) {
    if (std::any_of(own.begin(), own.end(), [n = name](const auto& b) { return b.first == n; })) continue;
    if (!root.has(name)) continue;
    std::vector<std::string> names;
    for (const auto& body : own) names.push_back(body.first);
    root.know(name);
    root.refuse(name, "this machine has no " + name + " to be analysed; it has " + listed(names));
  }
  machine.check_bodies(scene, tables);
  return tables;
}

}  // namespace pipelines
