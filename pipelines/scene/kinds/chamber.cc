#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {
namespace {

/// Opposite forces on the first two feet make a couple only at a distance.
void check_guide_by_feet(SceneTable& table, const kinetics::VibratoryMill& mill) {
  const auto& springs = mill.springs;
  if (springs.size() < 2 || springs[0].position_m.x() == springs[1].position_m.x())
    table.refuse("pitch_guide",
                 "needs two springs, one beside the other, to pull and push by; write \"body\"");
}

class ChamberReader : public BodyReader, ChamberNames {
public:
  std::string machine_type() const override { return "vibratory_mill"; }
  std::vector<std::string> tables() const override { return {"chamber"}; }
  BodyOptions read_options(SceneTable& table, const Scene& scene) const override {
    ChamberOptions options;
    const std::string guide =
        table.text_or("pitch_guide", "body", "where the couple of a held attitude goes");
    if (guide == "feet") {
      options.pitch_guide = PitchGuide::feet;
      check_guide_by_feet(table, scene.vibratory_mill());
    } else if (!guide.empty() && guide != "body") {
      table.refuse("pitch_guide", "write \"body\" (a body load about the mass centre) or \"feet\"");
    }
    options.elastic_feet =
        table.flag_or("elastic_feet", false, "the springs' stiffness is no part of the body");
    return options;
  }
  ContourRules contour_rules(const Scene& scene, const BodyScene&) const override {
    ContourRules rules;
    rules.ports = {bore, wall};
    for (std::size_t i = 1; i <= scene.vibratory_mill().springs.size(); ++i) rules.ports.push_back(foot(i));
    return rules;
  }
  BodyShape read_shape(SceneTable& table, const Scene& scene, const BodyScene&,
                       SceneFindings&) const override {
    return read_chamber_shape(table, scene.vibratory_mill(), scene.milling_space);
  }
  std::vector<std::string> bearing_loads(const BodyScene&) const override { return {bore}; }
  bool shares_masses() const override { return true; }
  std::optional<std::string> usual_difference_port(const BodyScene&) const override { return "covers"; }
  void read_region(SceneTable& entry, AddedMass& added) const override {
    added.region = entry.text_or("moves_with", added.port == bore ? "exciter" : "structure",
                                 "by its port; whose mass it counts to");
    if (added.region != "structure" && added.region != "exciter" && !added.region.empty())
      entry.refuse("moves_with", "write \"structure\" or \"exciter\"");
  }
  bool has_elastic_feet(const BodyScene& body) const override {
    return std::get<ChamberOptions>(body.options).elastic_feet;
  }
  std::vector<std::string> supporting_ports(const BodyScene&) const override { return {}; }
};

}  // namespace

const BodyReader& chamber_reader() {
  static const ChamberReader reader;
  return reader;
}

}  // namespace pipelines
