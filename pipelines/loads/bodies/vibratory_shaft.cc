#include "pipelines/loads/bodies/vibratory_shaft.h"

#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
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

class VibratoryShaftLoads : public LoadMaker {
public:
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement&) const override {
    const auto& shares = std::get<VibratoryShaftOptions>(body.options).debalance_shares;
    VibratoryShaftLoading loading;
    loading.gravity_m_s2 = scene.vibratory_mill().gravity_m_s2;
    loading.own_weight = scene.has_effect(VibratoryShaftNames::weight);
    loading.own_inertia = scene.has_effect(VibratoryShaftNames::inertia);
    loading.debalance_shares = {shares.at(0), shares.at(1)};
    return distribute_vibratory_shaft(history, loaded, loading);
  }
  /// What the bearings and the coupling carry with the shaft's own mass, beside the load stage's massless
  /// figures.
  std::vector<kinetics::Quantity> quantities(const BodyLoads& loads) const override {
    return {
        {VibratoryShaftNames::bearing_reaction, "N", "bearing reaction with the shaft's own mass, magnitude",
         loads.frame_bearing_force_N.matrix().colwise().norm().transpose()},
        {"T_shaft", "N m", "drive torque with the shaft's own mass, clockwise positive",
         loads.drive_torque_Nm}};
  }
  double spin_Hz(const Scene&, const BodyScene&, const kinetics::LoadHistory& loads) const override {
    return std::abs(loads.speed_rad_s.mean()) / (2 * pi);
  }
  int turning(const Scene&, const BodyScene&) const override { return -1; }  // as phi
};

}  // namespace

BodyLoads distribute_vibratory_shaft(const kinetics::LoadHistory& loads, const LoadedBody& body,
                                     const VibratoryShaftLoading& loading) {
  if (!loads.has_resultant("eccentric") || !loads.has_resultant("drive"))
    throw StageRefused("the load history of convention \"" + loads.convention +
                       "\" has no closed loads for a shaft: analyse bodies under \"consistent\"");
  const Index n = loads.n_instants();
  const ArrayXd alpha = -loads.phi_rad;  // phi is clockwise
  const auto& frame = loads.resultant("frame_bearings");
  LoadCollector collector(body, loads.effects, n, frame.total.topRows<2>().abs().maxCoeff());

  // -B through the seat's own axis, no torque.
  for (const auto& part : loads.resultant("eccentric").contributions)
    collector.force(VibratoryShaftNames::seat, part.effect, turned(part.load.topRows<2>(), alpha));

  // Debalances: their share of force, and of its moment about E, which the seat (concentric) takes as a
  // torque.
  const std::array<std::string, 2> debalances{VibratoryShaftNames::debalance_1,
                                              VibratoryShaftNames::debalance_2};
  if (loads.has_resultant("debalance"))
    for (const auto& part : loads.resultant("debalance").contributions)
      for (std::size_t i = 0; i < 2; ++i) {
        const double share = loading.debalance_shares[i];
        collector.force(debalances[i], part.effect, share * turned(part.load.topRows<2>(), alpha));
        collector.torque(debalances[i], part.effect, share * part.load.row(2).transpose());
      }

  // The body's own weight and inertia: d'Alembert accelerations; resultants and moments from the mesh.
  const auto& volume = body.region();
  std::vector<std::size_t> own_effects;
  if (loading.own_weight) {
    Array2Xd fixed = Array2Xd::Zero(2, n);
    fixed.row(1) = -loading.gravity_m_s2;
    AccelerationField weight{Array3Xd::Zero(3, n), {}, {}};
    weight.translation_m_s2.topRows<2>() = turned(fixed, alpha);
    own_effects.push_back(collector.effect(VibratoryShaftNames::weight));
    collector.accelerate(volume, own_effects.back(), weight);
  }
  if (loading.own_inertia) {
    own_effects.push_back(collector.effect(VibratoryShaftNames::inertia));
    collector.accelerate(volume, own_effects.back(),
                         {{}, loads.acceleration_rad_s2, loads.speed_rad_s.square()});
  }

  // Bearings: the resultant reaction is the load stage's R_E less the body's own loads; where it acts follows
  // from the moments about bearing 1. The closure of forces then remains a check of the load stage, not an
  // assumption. The coupling takes the drive torque and the moment of the body's own loads about E.
  std::map<std::size_t, Array2Xd> reaction;
  for (const auto& part : frame.contributions) reaction[part.effect] = turned(part.load.topRows<2>(), alpha);
  Array2Xd own_force = Array2Xd::Zero(2, n);
  ArrayXd own_torque = ArrayXd::Zero(n);  // counter-clockwise about E
  for (const std::size_t own : own_effects) {
    const Wrench sum = collector.sum(own);
    if (!(sum.abs().maxCoeff() > 0)) continue;
    reaction[own] = -sum.topRows<2>();
    own_force += sum.topRows<2>();
    own_torque += sum.row(5).transpose();
    collector.torque(VibratoryShaftNames::coupling, own, -sum.row(5).transpose());
  }
  for (const auto& part : loads.resultant("drive").contributions)
    collector.torque(VibratoryShaftNames::coupling, part.effect, part.load.row(2).transpose());
  collector.react(VibratoryShaftNames::bearing_1, VibratoryShaftNames::bearing_2, reaction);
  for (const char* seat :
       {VibratoryShaftNames::seat, VibratoryShaftNames::bearing_1, VibratoryShaftNames::bearing_2})
    collector.pressure(seat);

  auto result = collector.finish();
  result.frame_bearing_force_N = frame.total.topRows<2>() - turned(own_force, -alpha);
  result.drive_torque_Nm = -loads.resultant("drive").total.row(2).transpose() + own_torque;
  return result;
}

const LoadMaker& vibratory_shaft_loads() {
  static const VibratoryShaftLoads loads;
  return loads;
}

}  // namespace pipelines
