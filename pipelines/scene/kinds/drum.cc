#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {
namespace {

class DrumReader : public BodyReader, DrumNames {
public:
  std::string machine_type() const override { return "planetary_mill"; }
  std::vector<std::string> tables() const override { return {"drum"}; }
  BodyOptions read_options(SceneTable&, const Scene&) const override { return DrumOptions{}; }
  ContourRules contour_rules(const Scene&, const BodyScene&) const override {
    ContourRules rules;
    rules.ports = {wall, trunnion_1, trunnion_2, pulley};
    rules.middle = wall;
    return rules;
  }
  std::vector<std::string> bearing_loads(const BodyScene&) const override { return {trunnion_1, trunnion_2}; }
  std::optional<double> seat_speed_rad_s(const Scene& scene, const BodyScene&) const override {
    const auto& mill = std::get<kinetics::PlanetaryMill>(scene.machine);
    return mill.speed_rad_s * kinetics::planetary_geometry(mill).relative_speed_ratio;
  }
  std::vector<kinetics::EffectInfo> own_effects() const override {
    return {{spin, "Centrifugal field of the drum's own spin, without a resultant; from its mesh.",
             "coupling 4"}};
  }
  bool shares_masses() const override { return true; }
  std::optional<std::string> usual_difference_port(const BodyScene&) const override { return pulley; }
  std::vector<std::string> supporting_ports(const BodyScene&) const override {
    return {trunnion_1, trunnion_2};
  }
};

}  // namespace

const BodyReader& drum_reader() {
  static const DrumReader reader;
  return reader;
}

}  // namespace pipelines
