
#include "pipelines/common/errors.h"
#include "pipelines/loads/distribute.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

BodyLoads distribute_vibratory_shaft(const kinetics::LoadHistory& loads, const LoadedBody& body,
                                     const VibratoryShaftOptions& options) {
  if (!loads.has_resultant("eccentric") || !loads.has_resultant("drive"))
    throw StageRefused("the load history of convention \"" + loads.convention +
                       "\" has no closed loads for a shaft: analyse bodies under \"consistent\"");
  const Index n = loads.n_instants();
  const ArrayXd alpha = -loads.phi_rad;  // phi is clockwise
  auto effects = loads.effects;
  if (options.own_weight) effects.push_back("gravity_shaft");
  if (options.own_inertia) effects.push_back("shaft_inertia");
  const auto& frame = loads.resultant("frame_bearings");
  LoadCollector collector(body, effects, n, frame.total.topRows<2>().abs().maxCoeff());

  // -B through the seat's own axis, no torque.
  for (const auto& part : loads.resultant("eccentric").contributions)
    collector.force("eccentric_seat", part.effect, turned(part.load.topRows<2>(), alpha));

  // Debalances: their share of force, and of its moment about E, which the seat (concentric) takes as a
  // torque.
  const std::array<std::string, 2> debalances{"debalance_1", "debalance_2"};
  if (loads.has_resultant("debalance"))
    for (const auto& part : loads.resultant("debalance").contributions)
      for (std::size_t i = 0; i < 2; ++i) {
        const double share = options.debalance_shares[i];
        collector.force(debalances[i], part.effect, share * turned(part.load.topRows<2>(), alpha));
        collector.torque(debalances[i], part.effect, share * part.load.row(2).transpose());
      }

  // The body's own weight and inertia: d'Alembert accelerations; resultants and moments from the mesh.
  const auto& volume = body.region();
  if (options.own_weight) {
    Array2Xd fixed = Array2Xd::Zero(2, n);
    fixed.row(1) = -options.gravity_m_s2;
    AccelerationField weight{Array3Xd::Zero(3, n), {}, {}};
    weight.translation_m_s2.topRows<2>() = turned(fixed, alpha);
    collector.accelerate(volume, "gravity_shaft", weight);
  }
  if (options.own_inertia)
    collector.accelerate(volume, "shaft_inertia",
                         {{}, loads.acceleration_rad_s2, loads.speed_rad_s.square()});

  // Bearings: the resultant reaction is the load stage's R_E less the body's own loads; where it acts follows
  // from the moments about bearing 1. The closure of forces then remains a check of the load stage, not an
  // assumption. The coupling takes the drive torque and the moment of the body's own loads about E.
  std::map<std::string, Array2Xd> reaction;
  for (const auto& part : frame.contributions) reaction[part.effect] = turned(part.load.topRows<2>(), alpha);
  Array2Xd own_force = Array2Xd::Zero(2, n);
  ArrayXd own_torque = ArrayXd::Zero(n);  // counter-clockwise about E
  for (const char* own : {"gravity_shaft", "shaft_inertia"}) {
    const Wrench sum = collector.sum(own);
    if (!(sum.abs().maxCoeff() > 0)) continue;
    reaction[own] = -sum.topRows<2>();
    own_force += sum.topRows<2>();
    own_torque += sum.row(5).transpose();
    collector.torque("coupling", own, -sum.row(5).transpose());
  }
  for (const auto& part : loads.resultant("drive").contributions)
    collector.torque("coupling", part.effect, part.load.row(2).transpose());
  collector.react("main_bearing_1", "main_bearing_2", reaction);
  for (const char* seat : {"eccentric_seat", "main_bearing_1", "main_bearing_2"}) collector.pressure(seat);

  auto result = collector.finish();
  result.frame_bearing_force_N = frame.total.topRows<2>() - turned(own_force, -alpha);
  result.drive_torque_Nm = -loads.resultant("drive").total.row(2).transpose() + own_torque;
  return result;
}

}  // namespace pipelines
