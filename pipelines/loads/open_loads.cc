#include "pipelines/loads/open_loads.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "pipelines/common/errors.h"
#include "pipelines/loads/closure.h"

namespace pipelines {
namespace {

constexpr double round_off = 1e-9;  // of the loads' scale, as closure is judged

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
    return closure.force[c] > round_off ? closure.force[c] * closure.force_scale_N[c] : 0.0;
  };
  const auto moment = [&](std::size_t c) {
    return closure.moment[c] > round_off ? closure.moment[c] * closure.moment_scale_Nm[c] : 0.0;
  };
  return {std::max(force(0), force(1)), force(2), std::max(moment(0), moment(1)), moment(2)};
}

}  // namespace

void require_supports(const BodyScene& body, const BodyLoads& loads, const std::vector<RegionMass>& regions) {
  if (body.role != BodyRole::table_body || loads.unit_loads.empty()) return;
  std::vector<std::array<double, 6>> wanted;
  for (const auto& load : loads.unit_loads) wanted.push_back(wanted_resultant(load, regions));
  const auto left = remainder(check_closure(loads, wanted, regions));
  const std::string port = first_port(loads);
  std::string text;
  const auto refuse = [&](const char* key, const std::string& what) {
    text += fmt::format("{}{}.{}: is missing: {}", text.empty() ? "" : "\n", body.origin, key, what);
  };
  if (body.table.bearings.empty() && (left.across_N > 0 || left.tilting_Nm > 0))
    refuse("bearings", fmt::format("the loads leave up to {:.4g} N across the axis and {:.4g} N m of tilting "
                                   "that nothing carries; name the ports of two bearings, as bearings = "
                                   "[\"bearing_1\", \"bearing_2\"]",
                                   left.across_N, left.tilting_Nm));
  if (body.table.axial_support.empty() && left.along_N > 0)
    refuse("axial_support", fmt::format("the loads leave up to {:.4g} N along the axis that nothing carries; "
                                        "name the port that takes them, as axial_support = \"{}\"",
                                        left.along_N, port));
  if (body.table.torque_support.empty() && left.turning_Nm > 0)
    refuse("torque_support", fmt::format("the loads leave a torque of up to {:.4g} N m that nothing carries; "
                                         "name the port that takes it, as torque_support = \"{}\"",
                                         left.turning_Nm, port));
  if (!text.empty()) throw StageRefused(text);
}

}  // namespace pipelines
