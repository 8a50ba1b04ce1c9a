#include <cmath>

#include "pipelines/scene/kinds/kinds.h"

namespace pipelines {
namespace {

class VibratoryShaftReader : public BodyReader, VibratoryShaftNames {
public:
  std::string machine_type() const override { return "vibratory_mill"; }
  std::vector<std::string> tables() const override { return {"shaft"}; }
  BodyOptions read_options(SceneTable& table, const Scene&) const override {
    VibratoryShaftOptions options;
    auto& shares = options.debalance_shares;
    if (!table.is_given("debalance_shares")) {
      table.record_default("debalance_shares", "[0.5, 0.5]", "both debalances alike");
      return options;
    }
    shares = table.quantities("debalance_shares", "1", between(0, 1), 2);
    if (std::abs(shares[0] + shares[1] - 1) > 1e-9)
      table.refuse("debalance_shares", "must add up to 1: they are the shares of one mass");
    return options;
  }
  ContourRules contour_rules(const Scene& scene, const BodyScene&) const override {
    ContourRules rules;
    rules.ports = {seat, bearing_1, bearing_2, debalance_1, debalance_2, coupling};
    rules.middle = rules.eccentric_seat = seat;
    rules.eccentricity_m = scene.vibratory_mill().eccentricity_m;
    return rules;
  }
  std::vector<std::string> bearing_loads(const BodyScene&) const override {
    return {bearing_1, bearing_2, seat, bearing_reaction};
  }
  std::optional<double> seat_speed_rad_s(const Scene& scene, const BodyScene&) const override {
    return scene.vibratory_mill().speed_rad_s;
  }
  std::vector<kinetics::EffectInfo> own_effects() const override {
    return {
        {weight, "Weight of the shaft itself, from its mesh.", "coupling 2"},
        {inertia, "Centrifugal field and angular inertia of the shaft itself, from its mesh.", "coupling 2"}};
  }
  std::vector<std::string> supporting_ports(const BodyScene&) const override {
    return {bearing_1, bearing_2};
  }
};

}  // namespace

const BodyReader& vibratory_shaft_reader() {
  static const VibratoryShaftReader reader;
  return reader;
}

}  // namespace pipelines
