#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {
namespace {

class StubAxleReader : public BodyReader, StubAxleNames {
public:
  std::string machine_type() const override { return "planetary_mill"; }
  std::vector<std::string> tables() const override { return {"axle"}; }
  BodyOptions read_options(SceneTable& table, const Scene& scene) const override {
    const auto& mill = std::get<kinetics::PlanetaryMill>(scene.machine);
    StubAxleOptions axle;
    axle.bearing_span_m = table.quantity("bearing_span", "m", positive(100));
    axle.pulley_plane_m = table.quantity("pulley_plane", "m", between(-100, 100));
    axle.pulley_mass_kg =
        table.quantity_or("pulley_mass", "kg", not_negative(1e6), 0, "all of the drum at mid-span");
    if (axle.pulley_mass_kg > mill.drum_mass_kg)
      table.refuse("pulley_mass", "is more than machine.drum.mass, of which it is a part: " +
                                      shown(mill.drum_mass_kg) + " kg; check both");
    const std::string side = table.text_or("side", "plain", "the stub that carries more; or \"pulley\"");
    axle.pulley_side = side != "plain";
    if (!side.empty() && side != "plain" && side != "pulley")
      table.refuse("side", "write \"pulley\" or \"plain\": which of the two stubs");
    return axle;
  }
  ContourRules contour_rules(const Scene&, const BodyScene&) const override {
    ContourRules rules;
    rules.ports = {bearing, clamp};
    return rules;
  }
  std::vector<std::string> bearing_loads(const BodyScene&) const override { return {bearing}; }
  std::vector<kinetics::EffectInfo> own_effects() const override {
    return {{weight, "Weight of the stub itself, from its mesh.", "coupling 5"},
            {transport, "Centrifugal field of the stub that the carrier takes round, from its mesh.",
             "coupling 5"}};
  }
  std::vector<std::string> supporting_ports(const BodyScene&) const override { return {clamp}; }
  bool is_clamped(const BodyScene&) const override { return true; }
};

}  // namespace

const BodyReader& stub_axle_reader() {
  static const StubAxleReader reader;
  return reader;
}

}  // namespace pipelines
