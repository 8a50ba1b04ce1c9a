#include "pipelines/loads/channels/finite_loads.h"

#include <fmt/core.h>

#include <algorithm>

#include "pipelines/base/common/finite.h"

namespace pipelines {
namespace {

/// NaN stays where one of them is not finite: faster than asking each.
template <typename Values>
bool are_finite(const Values& values) {
  return (values * 0).sum() == 0;
}

struct HistoryGuard {
  const std::string& stage;
  const Eigen::ArrayXd& time_s;

  template <typename Values>
  void operator()(const std::string& what, const Values& values) const {
    if (are_finite(values)) return;
    for (Eigen::Index i = 0; i < values.cols(); ++i)
      if (!values.col(i).allFinite())
        refuse_not_finite(stage, what,
                          i < time_s.size() ? fmt::format(" at t = {:.6g} s", time_s[i])
                                            : fmt::format(" at instant {}", i));
  }
};

}  // namespace

void require_finite(const kinetics::LoadHistory& loads) {
  const std::string stage = "loads of the " + loads.machine;
  const HistoryGuard check{stage, loads.time_s};
  for (const auto& [name, values] : {std::pair{"the time [s]", &loads.time_s},
                                     {"the angle [rad]", &loads.phi_rad},
                                     {"the speed [rad/s]", &loads.speed_rad_s},
                                     {"the acceleration [rad/s2]", &loads.acceleration_rad_s2}})
    check(name, values->transpose());
  for (const auto& q : loads.quantities)
    if (q.has_statistics) check("\"" + q.name + "\" [" + q.unit + "]", q.values.transpose());
  for (const auto& resultant : loads.resultants) {
    check("the load \"" + resultant.role + "\" [N, N m]", resultant.total);
    for (const auto& part : resultant.contributions)
      check("the part of \"" + loads.effects[part.effect] + "\" in the load \"" + resultant.role +
                "\" [N, N m]",
            part.load);
  }
}

void require_finite(const BodyLoads& loads) {
  const auto& history = loads.history;
  const std::string stage = "distribution over the " + history.body;
  const Eigen::ArrayXd no_times;
  const HistoryGuard check{stage, no_times};
  const bool all_are_finite =
      are_finite(history.values) && std::all_of(history.by_effect.begin(), history.by_effect.end(),
                                                [](const auto& effect) { return are_finite(effect); });
  for (std::size_t k = 0; !all_are_finite && k < history.channels.size(); ++k) {
    const std::string name = "\"" + history.channels[k].name + "\" [" + history.channels[k].unit + "]";
    check(name, history.values.row(Eigen::Index(k)));
    for (std::size_t e = 0; e < history.by_effect.size(); ++e)
      check("the part of \"" + history.effects[e] + "\" in " + name,
            history.by_effect[e].row(Eigen::Index(k)));
  }
  check("the bearings' reaction [N]", loads.frame_bearing_force_N);
  check("the drive torque [N m]", loads.drive_torque_Nm.transpose());
  check("the guide's couple [N m]", loads.carried_moment_Nm.transpose());
}

}  // namespace pipelines
