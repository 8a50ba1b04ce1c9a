#include "pipelines/loads/bodies/table_body.h"

#include <fmt/core.h>

#include <algorithm>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/stage/machine_masses.h"

namespace pipelines {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

const char* const only_accelerations =
    "a force or moment on \"volume\": the body as a whole takes ax, ay, az and spin; name a port";

/// One load beside the planar resultants, "<port>.<component>".
void enter_table_load(LoadCollector& collector, const LoadedBody& body, std::size_t effect,
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

std::string first_port(const BodyLoads& loads) {
  for (const auto& load : loads.history.channels)
    if (const auto dot = load.name.find('.'); dot != std::string::npos && load.name.rfind("volume", 0) != 0)
      return load.name.substr(0, dot);
  return "end_1";
}

/// The sizes of what is left over: across, along, tilting, turning; 0 where that is round-off.
struct Remainder {
  double across_N = 0, along_N = 0, tilting_Nm = 0, turning_Nm = 0;
};

Remainder remainder(const Closure& closure) {
  const auto force = [&](std::size_t c) {
    return closure.force[c] > Closure::limit ? closure.force[c] * closure.force_scale_N[c] : 0.0;
  };
  const auto moment = [&](std::size_t c) {
    return closure.moment[c] > Closure::limit ? closure.moment[c] * closure.moment_scale_Nm[c] : 0.0;
  };
  return {std::max(force(0), force(1)), force(2), std::max(moment(0), moment(1)), moment(2)};
}

const TableBodyOptions& table_options(const BodyScene& body) {
  return std::get<TableBodyOptions>(body.options);
}

class TableBodyLoads : public LoadMaker {
public:
  BodyLoads distribute(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                       const LoadedBody& loaded, const MassAgreement&) const override {
    try {
      return distribute_table_at(history.phi_rad, std::get<kinetics::LoadTable>(scene.machine), scene.effects,
                                 scene.sampling, loaded, table_options(body));
    } catch (const StageRefused& refused) {
      throw StageRefused(body.origin + ": " + refused.what());
    }
  }
  void require_supports(const BodyScene& body, const BodyLoads& loads,
                        const std::vector<RegionMass>& regions) const override {
    const auto& table = table_options(body);
    if (loads.unit_loads.empty() || !table.clamp.empty()) return;
    std::vector<std::array<double, 6>> wanted;
    for (const auto& load : loads.unit_loads) wanted.push_back(wanted_resultant(load, regions));
    const auto left = remainder(check_closure(loads, wanted, regions));
    const std::string port = first_port(loads);
    std::string text;
    const auto refuse = [&](const char* key, const std::string& what) {
      text += fmt::format("{}{}.{}: is missing: {}", text.empty() ? "" : "\n", body.origin, key, what);
    };
    if (table.bearings.empty() && (left.across_N > 0 || left.tilting_Nm > 0))
      refuse("bearings",
             fmt::format("the loads leave up to {:.4g} N across the axis and {:.4g} N m of tilting "
                         "that nothing carries; name the ports of two bearings, as bearings = "
                         "[\"bearing_1\", \"bearing_2\"], or the port that holds the body, as clamp",
                         left.across_N, left.tilting_Nm));
    if (table.axial_support.empty() && left.along_N > 0)
      refuse("axial_support",
             fmt::format("the loads leave up to {:.4g} N along the axis that nothing carries; "
                         "name the port that takes them, as axial_support = \"{}\"",
                         left.along_N, port));
    if (table.torque_support.empty() && left.turning_Nm > 0)
      refuse("torque_support",
             fmt::format("the loads leave a torque of up to {:.4g} N m that nothing carries; "
                         "name the port that takes it, as torque_support = \"{}\"",
                         left.turning_Nm, port));
    if (!text.empty()) throw StageRefused(text);
  }
  std::string missing_support(const BodyScene& body, const Closure& closure) const override {
    const auto& table = table_options(body);
    if (!table.clamp.empty()) return "";
    if (closure.moment[2] > Closure::limit && table.torque_support.empty())
      return "name the port that takes torque, torque_support in [" + body.name + "]";
    if (closure.force[2] > Closure::limit && table.axial_support.empty())
      return "name the port that takes axial forces, axial_support in [" + body.name + "]";
    return table.bearings.empty() ? "name the ports of two bearings, bearings in [" + body.name + "]" : "";
  }
  /// Loads on a shaft may be along axes that turn with it; a part's are along its own.
  std::vector<double> spins_Hz(const Scene&, const BodyScene& body,
                               const kinetics::LoadHistory& loads) const override {
    if (body.name != "shaft") return {0};
    return {0, std::abs(loads.speed_rad_s.mean()) / (2 * pi)};
  }
};

}  // namespace

BodyLoads distribute_table_at(const Eigen::ArrayXd& phi_rad, const kinetics::LoadTable& table,
                              const std::vector<std::string>& effects, const kinetics::TimeGrid& grid,
                              const LoadedBody& body, const TableBodyOptions& options) {
  const auto all = kinetics::loads_at(table, effects, grid, phi_rad);
  double scale_N = 0;
  for (const auto& resultant : all.resultants)
    scale_N = std::max(scale_N, resultant.total.topRows<2>().abs().maxCoeff());
  LoadCollector collector(body, all.effects, all.n_instants(), scale_N);
  for (std::size_t effect = 0; effect < all.effects.size(); ++effect) {
    const auto own = kinetics::loads_at(table, {all.effects[effect]}, grid, phi_rad);
    for (const auto& resultant : own.resultants) {
      if (resultant.role == "volume")
        throw StageRefused("the effect \"" + all.effects[effect] + "\": " + only_accelerations);
      if (resultant.total.topRows<2>().abs().maxCoeff() > 0)
        collector.force(resultant.role, effect, resultant.total.topRows<2>());
      if (resultant.total.row(2).abs().maxCoeff() > 0)
        collector.torque(resultant.role, effect, resultant.total.row(2).transpose());
    }
    for (const auto& quantity : own.quantities)
      if (quantity.name.find('.') != std::string::npos) enter_table_load(collector, body, effect, quantity);
  }
  // Pressures of the loads; the bearings' pressure follows with what they carry altogether.
  const auto& bearings = options.bearings;
  for (const auto& port : body.ports)
    if (std::find(bearings.begin(), bearings.end(), port.name) == bearings.end())
      collector.pressure(port.name);
  // Axial forces are balanced first: off the axis of an eccentric port, one tilts the body, which the
  // bearings then carry.
  if (!options.axial_support.empty()) collector.react_axial(options.axial_support);
  if (!options.clamp.empty()) {  // what it carries spreads over the whole port
    collector.react_axial(options.clamp);
    collector.react_force(options.clamp);
    collector.react_tilt(options.clamp);
    collector.react_torque(options.clamp);
  }
  if (bearings.size() == 2) {
    collector.react(bearings[0], bearings[1]);
    for (const auto& bearing : bearings) collector.pressure(bearing);
  }
  if (!options.torque_support.empty()) collector.react_torque(options.torque_support);
  return collector.finish();
}

const LoadMaker& table_body_loads() {
  static const TableBodyLoads loads;
  return loads;
}

}  // namespace pipelines
