#include "pipelines/scene/bodies/scene_body_parts.h"

#include <algorithm>

#include "pipelines/base/names/nearest_name.h"

namespace pipelines {

BodyPorts ports_of(const BodyScene& body) {
  BodyPorts ports;
  if (const auto* shaft = body.shaft()) {
    for (const auto& segment : shaft->geometry.segments) {
      if (segment.is_port) ports.round.push_back(segment.name);
      if (!segment.bore_port.empty()) ports.round.push_back(segment.bore_port);
    }
    ports.all = ports.round;
    ports.all.insert(ports.all.end(), {"end_1", "end_2"});
  } else if (const auto* chamber = std::get_if<ChamberShape>(&body.shape)) {
    ports.round = {"housing_bore", "inner_wall"};
    ports.all = {"housing_bore", "inner_wall", "covers"};
    for (std::size_t i = 1; i <= chamber->geometry.feet.size(); ++i)
      ports.all.push_back("spring_foot_" + std::to_string(i));
  } else if (const auto* import = std::get_if<meshes::Import>(&body.shape)) {
    for (const auto& port : import->ports) {
      ports.all.push_back(port.name);
      if (port.kind != meshes::Port::Kind::face) ports.round.push_back(port.name);
    }
  }
  return ports;
}

void check_port(SceneTable& table, const std::string& key, const std::string& port,
                const std::vector<std::string>& known, const std::string& what_known) {
  if (known.empty() || port.empty() || std::find(known.begin(), known.end(), port) != known.end()) return;
  const std::string nearest = nearest_name(port, known);
  table.refuse(key,
               nearest.empty()
                   ? "\"" + port + "\" is none of " + what_known + ", which are: " + listed(known)
                   : "\"" + port + "\" is none of " + what_known + "; did you mean \"" + nearest + "\"?");
}

}  // namespace pipelines
