#include "pipelines/loads/bodies/stub_axle.h"

#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/bodies/planetary_fields.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/kinds/body_names.h"
#include "pipelines/scene/values/effect_names.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

class StubAxleLoads : public LoadMaker {
public:
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement& masses) const override {
    return distribute_stub_axle(history, std::get<kinetics::PlanetaryMill>(masses.machine), loaded,
                                std::get<StubAxleOptions>(body.options), scene.effects);
  }
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
    collector.force(StubAxleNames::bearing, part.effect, share);
  }
  const double omega2 = mill.speed_rad_s * mill.speed_rad_s;
  if (contains(effects, StubAxleNames::weight))
    collector.accelerate(body.region(), collector.effect(StubAxleNames::weight),
                         planetary::translation(acceleration_of_gravity));
  if (contains(effects, StubAxleNames::transport)) {
    auto field = planetary::translation(acceleration_of_transport);
    field.spin_rad2_s2 = ArrayXd::Constant(loads.n_instants(), omega2);
    collector.accelerate(body.region(), collector.effect(StubAxleNames::transport), field);
  }
  collector.pressure(
      StubAxleNames::bearing);  // before the clamp: what it carries spreads over the whole face
  collector.react_force(StubAxleNames::clamp);
  collector.react_tilt(StubAxleNames::clamp);
  collector.react_torque(StubAxleNames::clamp);
  return collector.finish();
}

const LoadMaker& stub_axle_loads() {
  static const StubAxleLoads loads;
  return loads;
}

}  // namespace pipelines
