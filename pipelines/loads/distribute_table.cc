#include <algorithm>

#include "pipelines/common/errors.h"
#include "pipelines/loads/distribute.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

const char* const only_accelerations =
    "a force or moment on \"volume\": the body as a whole takes ax, ay, az and spin; name a port";

/// One load beside the planar resultants, "<port>.<component>".
void enter(LoadCollector& collector, const LoadedBody& body, const std::string& effect,
           const kinetics::Quantity& load) {
  const auto dot = load.name.rfind('.');
  const std::string port = load.name.substr(0, dot), component = load.name.substr(dot + 1);
  const ArrayXd& values = load.values;
  if (port == "volume") {
    AccelerationField field{Array3Xd::Zero(3, values.size()), {}, {}};
    if (component == "ax" || component == "ay")
      field.translation_m_s2.row(component == "ax" ? 0 : 1) = values.transpose();
    else
      field.translation_m_s2.resize(3, 0);
    if (component == "fz" || component == "mx" || component == "my")
      throw StageRefused("the load \"" + load.name + "\": " + only_accelerations);
    if (component == "az") field.angular_rad_s2 = values;
    if (component == "spin") field.spin_rad2_s2 = values;
    return collector.accelerate(body.region(), effect, field);
  }
  if (component == "fz") return collector.axial_force(port, effect, values);
  if (component != "mx" && component != "my")
    throw StageRefused("the load \"" + load.name + "\": \"" + component +
                       "\" belongs to the whole body; write \"volume." + component + "\"");
  Array2Xd moment = Array2Xd::Zero(2, values.size());
  moment.row(component == "mx" ? 0 : 1) = values.transpose();
  collector.tilt(port, effect, moment);
}

}  // namespace

BodyLoads distribute_table(const kinetics::LoadTable& table, const std::vector<std::string>& effects,
                           const kinetics::TimeGrid& grid, const LoadedBody& body,
                           const TableBodyOptions& options) {
  const auto all = kinetics::compute_loads(table, effects, grid);
  double scale_N = 0;
  for (const auto& resultant : all.resultants)
    scale_N = std::max(scale_N, resultant.total.topRows<2>().abs().maxCoeff());
  LoadCollector collector(body, all.effects, all.n_instants(), scale_N);
  for (const auto& effect : all.effects) {
    const auto own = kinetics::compute_loads(table, {effect}, grid);
    for (const auto& resultant : own.resultants) {
      if (resultant.role == "volume")
        throw StageRefused("the effect \"" + effect + "\": " + only_accelerations);
      if (resultant.total.topRows<2>().abs().maxCoeff() > 0)
        collector.force(resultant.role, effect, resultant.total.topRows<2>());
      if (resultant.total.row(2).abs().maxCoeff() > 0)
        collector.torque(resultant.role, effect, resultant.total.row(2).transpose());
    }
    for (const auto& quantity : own.quantities)
      if (quantity.name.find('.') != std::string::npos) enter(collector, body, effect, quantity);
  }
  // Of the loads; the bearings' follows with what they carry altogether.
  const auto& bearings = options.bearings;
  for (const auto& port : body.ports)
    if (std::find(bearings.begin(), bearings.end(), port.name) == bearings.end())
      collector.pressure(port.name);
  if (bearings.size() == 2) {
    collector.react(bearings[0], bearings[1]);
    for (const auto& bearing : bearings) collector.pressure(bearing);
  }
  if (!options.axial_support.empty()) collector.react_axial(options.axial_support);
  if (!options.torque_support.empty()) collector.react_torque(options.torque_support);
  return collector.finish();
}

}  // namespace pipelines
