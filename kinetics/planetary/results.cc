#include <algorithm>
#include <cmath>
#include <optional>

#include "kinetics/planetary/balance.h"
#include "kinetics/planetary/closure.h"
#include "kinetics/planetary_effects/belt.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics::planetary {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

void write_axle(LoadHistory& history) {
  const Array2Xd axle_N = history.resultant("axle").total.topRows<2>();
  const ArrayXd X_N = axle_N.row(0).transpose(), Y_N = -axle_N.row(1).transpose();
  const ArrayXd R_N = X_N.binaryExpr(Y_N, [](double x, double y) { return std::hypot(x, y); });
  auto& q = history.quantities;
  q.push_back({"X_A", "N", "load on the axle outwards along OA; (14), (16)", X_N});
  q.push_back({"Y_A", "N", "load on the axle against the carrier's motion; (14), (17)", Y_N});
  q.push_back({"R_A", "N", "load on the axle, magnitude; (18)", R_N});
}

void write_motion(const Machine& machine, LoadHistory& history) {
  const auto steady = [&](double value) { return ArrayXd::Constant(history.n_instants(), value); };
  const double omega = machine.mill.speed_rad_s;
  const PlanetaryGeometry& g = machine.geometry;
  auto& q = history.quantities;
  q.push_back({"psi", "rad", "angle of the drum against the carrier, psi0 - Omega t / c",
               machine.mill.initial_drum_angle_rad +
                   g.relative_speed_ratio * (history.phi_rad - machine.mill.initial_angle_rad)});
  q.push_back({"drum_speed", "rad/s", "absolute spin of the drum, Omega (c - 1) / c; (1), (4) with its sign",
               steady(g.drum_speed_ratio * omega)});
  q.push_back({"drum_relative_speed", "rad/s", "spin of the drum against the carrier, -Omega / c",
               steady(g.relative_speed_ratio * omega)});
}

/// Power of the weights on the masses that the carrier takes round.
ArrayXd gravity_power_W(const Machine& machine, const LoadHistory& history) {
  ArrayXd moment_Nm = ArrayXd::Zero(history.n_instants());  // about O
  for (const Resultant& resultant : history.resultants)
    if (resultant.role == "drum" || resultant.role == "inner_wall")
      for (const Contribution& part : resultant.contributions)
        if (const std::string& effect = history.effects[part.effect];
            effect == "drum_gravity" || effect == "charge_gravity")
          moment_Nm += (machine.geometry.carrier_m * part.load.row(1) + part.load.row(2)).transpose();
  return moment_Nm * machine.mill.speed_rad_s;
}

void write_power(const Machine& machine, const ArrayXd& moment_Nm, bool belt_on, LoadHistory& history) {
  const double omega = machine.mill.speed_rad_s;
  const ArrayXd carrier_W = history.quantity("Y_A").values * (machine.geometry.carrier_m * omega);
  const ArrayXd relative_W = moment_Nm * (-machine.geometry.relative_speed_ratio * omega);
  auto& q = history.quantities;
  q.push_back(
      {"carrier_power", "W", "power that one drum's axle takes from the carrier, Y_A l_OA Omega", carrier_W});
  q.push_back(
      {"gravity_power", "W", "power of the weights of drum and charge", gravity_power_W(machine, history)});
  if (belt_on)
    q.push_back({"belt_power", "W",
                 "power that the belt gives the drum against the carrier, (T1 - T2) r_O Omega", relative_W});
  if (history.has_resultant("inner_wall"))
    q.push_back({"charge_power", "W", "friction power of the charge, M_A Omega / c", relative_W});
}

/// What closure cannot see: the paper's speed in (11) gives another force along the same line.
void warn_of_offset_speed(const Machine& machine, LoadHistory& history) {
  const double w = machine.offset_speed_rad_s, omega = machine.mill.speed_rad_s;
  if (!contains(history.effects, "charge_relative") ||
      std::abs(w * w - omega * omega) <= 1e-12 * omega * omega)
    return;
  history.warnings.push_back("under " + history.convention + " charge_relative takes the drum's spin of " +
                             rounded(w) + " rad/s for the carrier's " + rounded(omega) + ": " +
                             rounded(w * w / (omega * omega)) +
                             " times the force that it is; use it for the paper's figures only");
}

void warn_of_closure(const Machine& machine, LoadHistory& history) {
  const double force = history.quantity("closure_force").values.maxCoeff();
  const double moment = history.quantity("closure_moment").values.maxCoeff();
  if (machine.mill.convention == PlanetaryConvention::consistent || std::max(force, moment) <= 1e-12) return;
  const auto percent = [](double share) { return number(std::round(1e4 * share) / 100); };
  history.warnings.push_back("under " + history.convention + " the loads on the drum do not balance: up to " +
                             percent(force) + " % of the forces and " + percent(moment) +
                             " % of the moments are left over; use it for the paper's figures only");
}

}  // namespace

void write_results(const Machine& machine, const ArrayXd& moment_Nm, LoadHistory& history) {
  const bool belt_on = contains(history.effects, "belt");
  const ArrayXd difference_N = moment_Nm / machine.geometry.drum_pulley_m;
  std::optional<Tensions> belt;
  if (belt_on) belt = tensions(machine, difference_N);
  write_axle(history);
  auto& q = history.quantities;
  q.push_back({"M_A", "N m", "moment of the charge about A, which the belt balances; (14)", moment_Nm});
  if (belt_on) {
    q.push_back({"T1", "N", "strand that turns the drum against the carrier's sense", belt->T1_N});
    q.push_back({"T2", "N", "the other strand; (15)", belt->T2_N});
    q.push_back({"belt_difference", "N", "T1 - T2 = M_A / r_A", difference_N});
  } else {
    q.push_back({"drive_couple", "N m", "external couple on the drum in the belt's place, -M_A", -moment_Nm});
  }
  write_motion(machine, history);
  write_power(machine, moment_Nm, belt_on, history);
  const Closure closed = closure(machine, history, belt ? &*belt : nullptr);
  q.push_back({"closure_force", "1", "|sum of forces on the drum| / sum of |forces|", closed.force});
  q.push_back({"closure_moment", "1", "|sum of moments about A on the drum| / sum of |parts of moments|",
               closed.moment});
  if (belt)
    for (const std::string& warning : belt_warnings(machine, *belt)) history.warnings.push_back(warning);
  warn_of_closure(machine, history);
  warn_of_offset_speed(machine, history);
}

}  // namespace kinetics::planetary
