#include <algorithm>
#include <cmath>
#include <sstream>

#include "pipelines/common/errors.h"
#include "pipelines/common/name_lists.h"
#include "pipelines/loads/distribute.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

/// Conventions that leave a residual are not for bodies; where the two readings agree they may.
void require_equilibrium(const kinetics::LoadHistory& loads) {
  const double force = loads.quantity("closure_force").values.maxCoeff(),
               moment = loads.quantity("closure_moment").values.maxCoeff();
  if (force <= 1e-12 && moment <= 1e-12) return;
  std::ostringstream text;
  text << "the convention \"" << loads.convention << "\" leaves " << 100 * force << " % of the forces and "
       << 100 * moment << " % of the moments without a counterpart: analyse bodies under \"consistent\"";
  throw StageRefused(text.str());
}

/// G = -g (sin phi, cos phi) of the carrier frame.
Array2Xd gravity(const kinetics::LoadHistory& loads, double g_m_s2) {
  Array2Xd a(2, loads.n_instants());
  a.row(0) = -g_m_s2 * loads.phi_rad.sin().transpose();
  a.row(1) = -g_m_s2 * loads.phi_rad.cos().transpose();
  return a;
}

/// Omega^2 l_OA e_x of the carrier frame.
Array2Xd transport(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill) {
  Array2Xd a = Array2Xd::Zero(2, loads.n_instants());
  a.row(0) = mill.speed_rad_s * mill.speed_rad_s * kinetics::planetary_geometry(mill).carrier_m;
  return a;
}

AccelerationField translation(const Array2Xd& a) {
  AccelerationField field{Array3Xd::Zero(3, a.cols()), {}, {}};
  field.translation_m_s2.topRows<2>() = a;
  return field;
}

double typical_force(const kinetics::LoadHistory& loads) {
  return loads.resultant("axle").total.topRows<2>().abs().maxCoeff();
}

}  // namespace

BodyLoads distribute_drum(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                          const LoadedBody& body, const DrumOptions& options) {
  require_equilibrium(loads);
  const ArrayXd& psi = loads.quantity("psi").values;
  LoadCollector collector(body, loads.effects, loads.n_instants(), typical_force(loads));
  const auto enter = [&](const std::string& role, const std::string& port) {
    if (!loads.has_resultant(role)) return;
    for (const auto& part : loads.resultant(role).contributions) {
      collector.force(port, part.effect, turned(part.load.topRows<2>(), psi));
      collector.torque(port, part.effect, part.load.row(2).transpose());
    }
  };
  enter("inner_wall", "inner_wall");
  enter("pulley", "pulley_seat");

  const auto accelerate = [&](const std::string& effect, const AccelerationField& field) {
    if (!contains(options.effects, effect)) return;
    collector.accelerate(body.region(), effect, field);
    for (const auto& mass : options.attached) collector.accelerate(mass, effect, field);
  };
  accelerate("drum_transport", translation(turned(transport(loads, mill), psi)));
  accelerate("drum_gravity", translation(turned(gravity(loads, mill.gravity_m_s2), psi)));
  accelerate("drum_spin", {{}, {}, loads.quantity("drum_speed").values.square()});

  std::map<std::string, Array2Xd> reaction;
  for (const auto& part : loads.resultant("trunnions").contributions)
    reaction[part.effect] = turned(part.load.topRows<2>(), psi);
  collector.react("trunnion_1", "trunnion_2", reaction);
  for (const char* port : {"inner_wall", "pulley_seat", "trunnion_1", "trunnion_2"}) collector.pressure(port);
  return collector.finish();
}

BodyLoads distribute_stub_axle(const kinetics::LoadHistory& loads, const kinetics::PlanetaryMill& mill,
                               const LoadedBody& body, const StubAxleOptions& options) {
  require_equilibrium(loads);
  LoadCollector collector(body, loads.effects, loads.n_instants(), typical_force(loads));
  const double off_middle = options.pulley_plane_m / options.bearing_span_m * (options.pulley_side ? 1 : -1);
  const Array2Xd acceleration_of_gravity = gravity(loads, mill.gravity_m_s2),
                 acceleration_of_transport = transport(loads, mill);
  for (const auto& part : loads.resultant("axle").contributions) {
    Array2Xd share = part.load.topRows<2>() / 2;
    if (part.effect == "belt") share += off_middle * part.load.topRows<2>();
    if (part.effect == "drum_gravity") share += off_middle * options.pulley_mass_kg * acceleration_of_gravity;
    if (part.effect == "drum_transport")
      share += off_middle * options.pulley_mass_kg * acceleration_of_transport;
    collector.force("bearing", part.effect, share);
  }
  const double omega2 = mill.speed_rad_s * mill.speed_rad_s;
  if (contains(options.effects, "axle_gravity"))
    collector.accelerate(body.region(), "axle_gravity", translation(acceleration_of_gravity));
  if (contains(options.effects, "axle_transport")) {
    auto field = translation(acceleration_of_transport);
    field.spin_rad2_s2 = ArrayXd::Constant(loads.n_instants(), omega2);
    collector.accelerate(body.region(), "axle_transport", field);
  }
  collector.pressure("bearing");  // before the clamp: what it carries spreads over the whole face
  collector.react_force("clamp");
  collector.react_tilt("clamp");
  collector.react_torque("clamp");
  return collector.finish();
}

}  // namespace pipelines
