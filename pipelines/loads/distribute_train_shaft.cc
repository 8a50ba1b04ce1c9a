#include <algorithm>
#include <stdexcept>

#include "pipelines/loads/distribute.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

BodyLoads distribute_train_shaft(const kinetics::LoadHistory& loads, double mean_speed_rad_s,
                                 const LoadedBody& body, const TrainShaftOptions& options) {
  const Index n = loads.n_instants();
  const auto torque_of = [&](const std::string& role) -> const kinetics::Resultant& {
    return loads.resultant(role);
  };
  double largest_torque = 0, smallest_radius = 1e300;
  for (const auto& torque : options.torques)
    largest_torque = std::max(largest_torque, torque_of(torque.role).total.row(2).abs().maxCoeff());
  for (const auto& port : body.ports)
    if (port.radius_m > 0) smallest_radius = std::min(smallest_radius, port.radius_m);
  LoadCollector collector(body, loads.effects, n, std::max(largest_torque / smallest_radius, 1e-300));

  for (const auto& torque : options.torques)
    for (const auto& part : torque_of(torque.role).contributions)
      collector.torque(torque.port, part.effect, part.load.row(2).transpose());
  for (const std::string prefix : {"excitation_on_", "damping_on_"})
    if (const std::string role = prefix + options.inertia; loads.has_resultant(role))
      for (const auto& part : loads.resultant(role).contributions)
        for (const auto& bearing : options.bearings)
          collector.torque(bearing, part.effect, part.load.row(2).transpose() / 2);

  if (std::find(options.effects.begin(), options.effects.end(), "shaft_inertia") != options.effects.end()) {
    const AccelerationField field{{}, -loads.quantity(options.inertia + ".acceleration").values, {}};
    collector.accelerate(body.region(), "shaft_inertia", field);
    for (const auto& mass : options.attached) collector.accelerate(mass, "shaft_inertia", field);
  }

  // Across and along: only what the scene asks for beyond torsion.
  const ArrayXd angle = mean_speed_rad_s * loads.time_s + loads.quantity(options.inertia + ".angle").values;
  for (const auto& force : options.forces) {
    Array2Xd across(2, n);
    for (Index d = 0; d < 2; ++d) across.row(d) = force.force_N[std::size_t(d)];
    if (!force.turns_with_shaft) across = turned(across, angle);
    if (across.abs().maxCoeff() > 0) collector.force(force.port, force.effect, across);
    if (force.force_N[2] != 0)
      collector.axial_force(force.port, force.effect, ArrayXd::Constant(n, force.force_N[2]));
  }
  if (!options.forces.empty()) {
    collector.react(options.bearings[0], options.bearings[1]);
    if (!options.axial_bearing.empty()) collector.react_axial(options.axial_bearing);
    for (const auto& port : body.ports) collector.pressure(port.name);
  }
  return collector.finish();
}

}  // namespace pipelines
