#include <algorithm>

#include "pipelines/scene/bodies/scene_body_parts.h"
#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {
namespace {

/// Ports that the loads of a table enter by; end faces are always there.
void add_table_ports(const Scene& scene, std::vector<std::string>& ports) {
  for (const auto& load : std::get<kinetics::LoadTable>(scene.machine).loads) {
    const bool is_face = load.port == "end_1" || load.port == "end_2" || load.port == "volume";
    if (!is_face && scene.has_effect(load.effect) &&
        std::find(ports.begin(), ports.end(), load.port) == ports.end())
      ports.push_back(load.port);
  }
}

/// Forces need a surface, accelerations the whole body.
void check_table_loads(SceneTable& body, const Scene& scene) {
  for (const auto& load : std::get<kinetics::LoadTable>(scene.machine).loads) {
    const auto& c = load.component;
    const bool is_field = c == "ax" || c == "ay" || c == "az" || c == "spin";
    if (!scene.has_effect(load.effect) || is_field == (load.port == "volume")) continue;
    const std::string name = "the load \"" + load.port + "." + c + "\" ";
    body.refuse_missing("", is_field ? name + "belongs to the whole body; write \"volume." + c + "\""
                                     : name +
                                           "has no place to enter: the body as a whole takes ax, ay, az "
                                           "and spin; name a port");
  }
}

const TableBodyOptions& table_options(const BodyScene& body) {
  return std::get<TableBodyOptions>(body.options);
}

class TableBodyReader : public BodyReader {
public:
  std::string machine_type() const override { return "load_table"; }
  std::vector<std::string> tables() const override { return {"shaft", "part"}; }
  BodyOptions read_options(SceneTable& table, const Scene& scene) const override {
    TableBodyOptions options;
    table.know("bearings");
    if (table.is_given("clamp")) {
      options.clamp = table.text("clamp");
      for (const char* other : {"bearings", "axial_support", "torque_support"})
        if (table.has(other))
          table.refuse(other, "stands beside clamp, which takes all forces and moments; remove one of both");
    } else if (table.has("bearings")) {
      auto& bearings = options.bearings;
      for (const auto& name : table.texts("bearings")) bearings.push_back(name.text);
      if (bearings.size() != 2 || bearings[0] == bearings[1])
        table.refuse("bearings",
                     "needs the ports of two bearings; one port that holds the body is its clamp");
    }
    for (auto* support : {&options.axial_support, &options.torque_support}) {
      const char* key = support == &options.axial_support ? "axial_support" : "torque_support";
      if (table.is_given(key)) *support = table.text(key);
    }
    check_table_loads(table, scene);
    return options;
  }
  ContourRules contour_rules(const Scene& scene, const BodyScene& body) const override {
    ContourRules rules;
    rules.any_port = true;
    rules.ports = table_options(body).bearings;
    add_table_ports(scene, rules.ports);
    return rules;
  }
  void check_ports(SceneTable& table, const BodyScene& body) const override {
    const auto known = ports_of(body).all;
    const auto& options = table_options(body);
    check_port(table, "clamp", options.clamp, known, "the ports of this body");
    check_port(table, "axial_support", options.axial_support, known, "the ports of this body");
    check_port(table, "torque_support", options.torque_support, known, "the ports of this body");
  }
  std::vector<std::string> bearing_loads(const BodyScene& body) const override {
    return table_options(body).bearings;
  }
  std::optional<double> seat_speed_rad_s(const Scene& scene, const BodyScene& body) const override {
    if (body.name != "shaft") return std::nullopt;
    return std::get<kinetics::LoadTable>(scene.machine).speed_rad_s;
  }
  std::vector<std::string> supporting_ports(const BodyScene& body) const override {
    const auto& table = table_options(body);
    return table.clamp.empty() ? table.bearings : std::vector<std::string>{table.clamp};
  }
  bool is_clamped(const BodyScene& body) const override { return !table_options(body).clamp.empty(); }
};

}  // namespace

const BodyReader& table_body_reader() {
  static const TableBodyReader reader;
  return reader;
}

}  // namespace pipelines
