#include <cmath>

#include "kinetics/values/wrong_input.h"
#include "kinetics/vibratory_effects/effect_sums.h"
#include "kinetics/vibratory_effects/kinematics.h"

namespace kinetics::vibratory {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

ArrayXd magnitude(const Array2Xd& vectors) {
  return vectors.matrix().colwise().norm().transpose();
}

/// a / b, zero where b is.
ArrayXd relative(const ArrayXd& a, const ArrayXd& b) {
  return (b > 0).select(a / b.max(1e-300), 0.0);
}

void write_motion(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& at,
                  LoadHistory& history) {
  auto& q = history.quantities;
  q.push_back({"chi", "rad", "direction of the charge's centre from C, clockwise: phi + pi - delta, (4)",
               at.chi_rad});
  q.push_back({"theta", "rad", "pitch of the chamber about E', counter-clockwise", at.theta_rad});
  q.push_back({"theta_dot", "rad/s", "rate of the pitch", at.theta_rad_s});
  q.push_back({"theta_ddot", "rad/s2", "acceleration of the pitch", at.theta_rad_s2});
  if (contains(effects, "pitch"))
    q.push_back({"neglected_pitch_centripetal", "N",
                 "m1 theta'^2 |l|: centripetal force of the pitch, not in B",
                 mill.structure_mass_kg * mill.structure_centre_m.norm() * at.theta_rad_s.square()});
  write_kinematics(mill, effects, at, history);
}

void write_reactions(const EffectSums& sums, LoadHistory& history) {
  const Array2Xd B = history.resultant("housing_bore").total.topRows<2>();
  const Array2Xd R = history.resultant("frame_bearings").total.topRows<2>();
  const ArrayXd T = -history.resultant("drive").total.row(2).transpose();
  auto& q = history.quantities;
  q.push_back({"B_x", "N", "force of the eccentric on the chamber, horizontal", B.row(0).transpose()});
  q.push_back({"B_y", "N", "force of the eccentric on the chamber, vertical", B.row(1).transpose()});
  q.push_back({"B", "N", "force of the eccentric on the chamber, magnitude", magnitude(B)});
  q.push_back({"X_E", "N", "reaction of the frame's bearings on the shaft, horizontal; replaces (42)",
               R.row(0).transpose()});
  q.push_back({"Y_E", "N", "reaction of the frame's bearings on the shaft, vertical; replaces (43)",
               R.row(1).transpose()});
  q.push_back(
      {"R_E", "N", "reaction of the frame's bearings on the shaft, magnitude; replaces (44)", magnitude(R)});
  q.push_back({"T", "N m", "drive torque on the shaft, clockwise positive (the sense of rotation)", T});
  q.push_back({"drive_power", "W", "T phi'", T * history.speed_rad_s});
  q.push_back({"couple", "N m", "pitch inertia beyond m1 at l: -(I_E - m1 |l|^2) theta''", sums.couple_Nm});
}

void write_springs(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const EffectSums& sums,
                   LoadHistory& history) {
  if (!contains(effects, "springs") && !contains(effects, "spring_damping")) return;
  auto& q = history.quantities;
  ArrayXd vertical_N = ArrayXd::Zero(history.n_instants());
  for (std::size_t i = 1; i <= mill.springs.size(); ++i) {
    const auto& force = history.resultant("spring_foot_" + std::to_string(i)).total;
    const std::string name = "spring_" + std::to_string(i);
    q.push_back(
        {name + ".fx", "N", "force of the spring on the chamber, horizontal", force.row(0).transpose()});
    q.push_back(
        {name + ".fy", "N", "force of the spring on the chamber, vertical", force.row(1).transpose()});
    vertical_N += force.row(1).transpose();
    if (contains(effects, "springs") && force.row(1).minCoeff() < 0)
      history.warnings.push_back(name + " pulls the chamber down, by up to " +
                                 rounded(-force.row(1).minCoeff()) +
                                 " N: a spring that is not clamped to its foot would lift off");
  }
  q.push_back(
      {"spring_force", "N", "vertical force of all springs on the chamber; replaces (31)", vertical_N});
  if (contains(effects, "spring_damping"))
    q.push_back({"damping_power", "W", "power that spring_damping dissipates", sums.damping_power_W});
}

void write_charge(const VibratoryMill& mill, const EffectSums& sums, LoadHistory& history) {
  if (!history.has_resultant("inner_wall")) return;
  const auto& force = history.resultant("inner_wall").total;
  const Array2Xd at_m = position(mill, {Place::charge_centre, 0, {}, {}}, sums.motion);
  auto& q = history.quantities;
  q.push_back(
      {"charge_on_wall.fx", "N", "force of the charge on the wall, horizontal", force.row(0).transpose()});
  q.push_back(
      {"charge_on_wall.fy", "N", "force of the charge on the wall, vertical", force.row(1).transpose()});
  q.push_back(
      {"charge_at.x", "m", "centre of the charge, from E'; replaces DE (58)", at_m.row(0).transpose()});
  q.push_back(
      {"charge_at.y", "m", "centre of the charge, from E'; replaces OD (57)", at_m.row(1).transpose()});
  q.push_back({"charge_power", "W",
               "power that the charge takes from the chamber, -F . velocity; negative where the "
               "prescribed circulation gives",
               sums.charge_power_W});
}

void write_closure(const EffectSums& sums, LoadHistory& history) {
  const ArrayXd chamber_force = relative(magnitude(sums.chamber.force_N), sums.chamber.force_scale_N);
  const ArrayXd shaft_force = relative(magnitude(sums.shaft.force_N), sums.shaft.force_scale_N);
  const ArrayXd chamber_moment = relative(sums.chamber.moment_Nm.abs(), sums.chamber.moment_scale_Nm);
  const ArrayXd shaft_moment = relative(sums.shaft.moment_Nm.abs(), sums.shaft.moment_scale_Nm);
  auto& q = history.quantities;
  q.push_back({"moment_residual", "N m",
               "moment about E' that the chamber's loads leave, counter-clockwise: round-off "
               "with pitch on, what a guide carries with pitch off",
               sums.chamber.moment_Nm});
  q.push_back({"closure_force", "1", "|sum of forces| / sum of |forces|, the worse of chamber and shaft",
               chamber_force.max(shaft_force)});
  q.push_back({"closure_moment", "1",
               "|sum of moments| / sum of |parts of moments|, the worse of chamber about E' and "
               "shaft about E",
               chamber_moment.max(shaft_moment)});
}

void write_warnings(const VibratoryMill& mill, const LoadHistory& history, bool pitching,
                    std::vector<std::string>& warnings) {
  if (pitching && contains(history.effects, "charge_lag") && mill.charge_lag.grinding_power_W)
    warnings.push_back("charge_lag: the loss angle follows from the grinding power of " +
                       number(*mill.charge_lag.grinding_power_W) +
                       " W for a chamber that moves on the eccentric's circle alone; with pitch on the "
                       "charge takes another power: " +
                       "mean charge_power over the window is " +
                       rounded(history.quantity("charge_power").values.mean()) + " W");
  const double largest_rad = history.quantity("theta").values.abs().maxCoeff();
  if (largest_rad > 0.05)
    warnings.push_back(
        "the chamber pitches by up to " + rounded(largest_rad) +
        " rad: positions are not turned by theta, "
        "so forces are wrong by about that share; check the springs and the distance from resonance");
  const ArrayXd& T = history.quantity("T").values;
  const double least = T.minCoeff(), most = T.maxCoeff();
  if (least < -1e-9 * most && most > 0)
    warnings.push_back("the drive torque reverses in each cycle, from " + rounded(least) + " to " +
                       rounded(most) + " N m: keys, couplings and gears see changing contact");
  const double size_N = history.quantity("B").values.maxCoeff();
  const double neglected_N = pitching ? history.quantity("neglected_pitch_centripetal").values.maxCoeff() : 0;
  if (neglected_N > 0.05 * size_N)
    warnings.push_back("the neglected centripetal force of the pitch reaches " + rounded(neglected_N) +
                       " N, " + rounded(std::round(1000 * neglected_N / size_N) / 10) +
                       " % of the eccentric's force");
}

}  // namespace

void write_results(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, EffectSums& sums,
                   LoadHistory& history) {
  history.resultants = sums.take_resultants();
  const bool pitching = contains(effects, "pitch");
  write_motion(mill, effects, sums.motion, history);
  write_reactions(sums, history);
  write_springs(mill, effects, sums, history);
  write_charge(mill, sums, history);
  write_closure(sums, history);
  write_warnings(mill, history, pitching, history.warnings);
}

}  // namespace kinetics::vibratory
