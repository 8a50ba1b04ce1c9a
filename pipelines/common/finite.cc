#include "pipelines/common/finite.h"

#include <fmt/core.h>

#include <cmath>

#include "pipelines/common/errors.h"
#include "pipelines/report/torsion_report.h"

namespace pipelines {
namespace {

const char* const remedy =
    "the scene's numbers are too large or too small for each other: look for a value with a wrong unit or "
    "exponent";

[[noreturn]] void fail(const std::string& stage, const std::string& what, const std::string& where) {
  throw NotFinite(fmt::format("{}: {} is not finite{}; {}", stage, what, where, remedy));
}

/// Where the first value is that is not finite; -1: nowhere.
template <typename Values>
Eigen::Index first_fault(const Values& values) {
  if (values.size() == 0 || values.allFinite()) return -1;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values(i))) return i;
  return -1;
}

struct HistoryGuard {
  const std::string& stage;
  const Eigen::ArrayXd& time_s;

  template <typename Values>
  void operator()(const std::string& what, const Values& values) const {
    if (values.size() == 0 || values.allFinite()) return;
    for (Eigen::Index i = 0; i < values.cols(); ++i)
      if (!values.col(i).allFinite())
        fail(stage, what,
             i < time_s.size() ? fmt::format(" at t = {:.6g} s", time_s[i])
                               : fmt::format(" at instant {}", i));
  }
};

/// Of one value for each node, or several.
void check_nodes(const std::string& stage, const std::string& what, const std::vector<double>& values,
                 std::size_t per_node) {
  const Eigen::Map<const Eigen::ArrayXd> all(values.data(), Eigen::Index(values.size()));
  if (const auto at = first_fault(all); at >= 0)
    fail(stage, what, fmt::format(" at node {}", std::size_t(at) / std::max<std::size_t>(1, per_node)));
}

void check_maximum(const std::string& stage, const std::string& what, const NodalMaximum& maximum) {
  check_nodes(stage, what, maximum.value_Pa, 1);
  for (std::size_t i = 0; i < maximum.stress_Pa.size(); ++i)
    for (const double component : maximum.stress_Pa[i])
      if (!std::isfinite(component)) fail(stage, what, fmt::format(" at node {}", i));
}

}  // namespace

void require_finite(const std::string& stage, const std::string& what, double value) {
  if (!std::isfinite(value)) fail(stage, what, "");
}

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
      check("the part of \"" + part.effect + "\" in the load \"" + resultant.role + "\" [N, N m]", part.load);
  }
}

void require_finite(const BodyLoads& loads) {
  const auto& history = loads.history;
  const std::string stage = "distribution over the " + history.body;
  const Eigen::ArrayXd no_times;
  const HistoryGuard check{stage, no_times};
  for (std::size_t k = 0; k < history.channels.size(); ++k) {
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

void require_finite(const fem::UnitResponses& responses) {
  const auto n_channels = responses.channels.size();
  check_nodes("solve", "the displacement for a unit load [m]", responses.displacement_m, 3 * n_channels);
  check_nodes("stress recovery", "the stress for a unit load [Pa]", responses.stress_Pa, 6 * n_channels);
  for (const auto& section : responses.sections)
    for (const double component : section.resultant)
      require_finite("solve", "the resultant of a section [N, N m]", component);
}

void require_finite(const std::string& body, const Envelope& envelope) {
  const std::string stage = "superposition on the " + body;
  check_maximum(stage, "the von Mises stress [Pa]", envelope.von_mises);
  check_maximum(stage, "the largest principal stress [Pa]", envelope.principal);
  const auto n = std::max<std::size_t>(1, envelope.von_mises.value_Pa.size());
  check_nodes(stage, "an effect's share of the stress", envelope.effect_share,
              envelope.effect_share.size() / n);
}

void require_finite(const TorsionReport& torsion) {
  const std::string stage = "torsion";
  const auto check = [&](const std::string& what, const auto& values) {
    if (values.size() > 0 && !values.allFinite()) fail(stage, what, "");
  };
  check("a natural frequency [rad/s]", torsion.modes.frequency_rad_s);
  check("a mode's shape", torsion.modes.shape);
  check("a mode's share of kinetic energy", torsion.modes.kinetic_share);
  check("a mode's share of potential energy", torsion.modes.potential_share);
  check("a mean torque [N m]", torsion.forced.mean_torque_Nm);
  for (const auto& harmonic : torsion.forced.harmonics) {
    check("a forced angle [rad]", harmonic.angle_rad.cwiseAbs().eval());
    check("a forced torque [N m]", harmonic.torque_Nm.cwiseAbs().eval());
  }
  for (const auto& t : torsion.torques)
    for (const double value : {t.mean_Nm, t.largest_Nm, t.largest_reduced_Nm, t.largest_shear_Pa})
      require_finite(stage, "the torque of \"" + t.element + "\" [N m] or its stress [Pa]", value);
  if (!torsion.transient) return;
  const auto& transient = *torsion.transient;
  check("a torque of the transient [N m]", transient.motion.torque_Nm);
  check("an angle of the transient [rad]", transient.motion.angle_rad);
  check("an energy of the transient [J]", (transient.kinetic_J + transient.potential_J).eval());
}

}  // namespace pipelines
