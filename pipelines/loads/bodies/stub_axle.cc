#include "pipelines/loads/bodies/stub_axle.h"

#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/bodies/planetary_fields.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/bodies/scene_body.h"
#include "pipelines/scene/values/effect_names.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

class StubAxleKind : public BodyKind {
public:
  // The axle's own effects.
  static constexpr const char *weight = "axle_gravity", *transport = "axle_transport";
  // The axle's ports.
  static constexpr const char *bearing = "bearing", *clamp = "clamp";

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
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement& masses) const override {
    return distribute_stub_axle(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                                std::get<StubAxleOptions>(body.options), scene.effects);
  }
  std::vector<std::string> supporting_ports(const BodyScene&) const override { return {clamp}; }
  bool is_clamped(const BodyScene&) const override { return true; }
};

}  // namespace

BodyLoads distribute_stub_axle(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                               const LoadedBody& body, const StubAxleOptions& options,
                               const std::vector<std::string>& effects) {
  planetary::require_equilibrium(loads);
  LoadCollector collector(body, loads.effects, loads.n_instants(), planetary::typical_force(loads));
  const double off_middle = options.pulley_plane_m / options.bearing_span_m * (options.pulley_side ? 1 : -1);
  const Array2Xd acceleration_of_gravity = planetary::gravity(loads, mill.gravity_m_s2),
                 acceleration_of_transport = planetary::transport(loads, mill);
  for (const auto& part : loads.resultant("axle").contributions) {
    const std::string& effect = loads.effects[part.effect];
    Array2Xd share = part.load.topRows<2>() / 2;
    if (effect == effect_name::belt) share += off_middle * part.load.topRows<2>();
    if (effect == effect_name::drum_gravity)
      share += off_middle * options.pulley_mass_kg * acceleration_of_gravity;
    if (effect == effect_name::drum_transport)
      share += off_middle * options.pulley_mass_kg * acceleration_of_transport;
    collector.force(StubAxleKind::bearing, part.effect, share);
  }
  const double omega2 = mill.speed_rad_s * mill.speed_rad_s;
  if (contains(effects, StubAxleKind::weight))
    collector.accelerate(body.region(), collector.effect(StubAxleKind::weight),
                         planetary::translation(acceleration_of_gravity));
  if (contains(effects, StubAxleKind::transport)) {
    auto field = planetary::translation(acceleration_of_transport);
    field.spin_rad2_s2 = ArrayXd::Constant(loads.n_instants(), omega2);
    collector.accelerate(body.region(), collector.effect(StubAxleKind::transport), field);
  }
  collector.pressure(StubAxleKind::bearing);  // before the clamp: what it carries spreads over the whole face
  collector.react_force(StubAxleKind::clamp);
  collector.react_tilt(StubAxleKind::clamp);
  collector.react_torque(StubAxleKind::clamp);
  return collector.finish();
}

const BodyKind& stub_axle_kind() {
  static const StubAxleKind kind;
  return kind;
}

}  // namespace pipelines
