#include "kinetics/vibratory_effects/kinematics.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "kinetics/values/constants.h"

namespace kinetics::vibratory {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;

/// A point over the instants, from C1.
struct PointMotion {
  Array2Xd position_m, velocity_m_s, acceleration_m_s2;

  void add(const PointMotion& more) {
    position_m += more.position_m;
    velocity_m_s += more.velocity_m_s;
    acceleration_m_s2 += more.acceleration_m_s2;
  }
};

/// Motion of the eccentric: s = ecc e(phi).
PointMotion circle_of_eccentric(const VibratoryMill& mill, const Instants& at) {
  return {translation(mill, at), translation_velocity(mill, at), translation_acceleration(mill, at)};
}

/// r e(chi), the charge's centre from C.
PointMotion circle_of_charge(const VibratoryMill& mill, const Instants& at) {
  const double r_m = mill.charge_offset_m;
  const ArrayXd speed = at.speed_rad_s + at.relative_speed_rad_s;
  const ArrayXd across = r_m * (at.acceleration_rad_s2 + at.relative_acceleration_rad_s2);
  return {r_m * at.along_chi, composed(ArrayXd::Zero(at.size()), r_m * speed, at.along_chi),
          composed(-r_m * speed.square(), across, at.along_chi)};
}

/// Motion of the chamber's centre by pitch: theta z x c.
PointMotion pitch_at_chamber_centre(const VibratoryMill& mill, const Instants& at) {
  const Array2Xd across_m = constant(turned(mill.chamber_centre_m), at.size());
  return {scaled(at.theta_rad, across_m), scaled(at.theta_rad_s, across_m),
          scaled(at.theta_rad_s2, across_m)};
}

/// What an angle phi - lag makes of a motion on the circle of phi.
PointMotion lagging(PointMotion motion, double lag_rad) {
  const Eigen::Matrix2d back = Eigen::Rotation2Dd(lag_rad).toRotationMatrix();
  for (Array2Xd* vectors : {&motion.position_m, &motion.velocity_m_s, &motion.acceleration_m_s2})
    *vectors = (back * vectors->matrix()).array();
  return motion;
}

struct PointTexts {
  std::string name, of, position_source, acceleration_source;
};

void write_point(const PointTexts& texts, const PointMotion& motion, LoadHistory& history) {
  const auto add = [&](const std::string& component, const std::string& unit, const std::string& what,
                       const Array2Xd& vectors) {
    for (const int row : {0, 1})
      history.quantities.push_back({texts.name + "." + component + (row == 0 ? "x" : "y"), unit,
                                    what + (row == 0 ? ", horizontal" : ", vertical"),
                                    vectors.row(row).transpose()});
  };
  add("", "m", texts.of + ", from C1, the chamber's centre at rest, " + texts.position_source,
      motion.position_m);
  add("v", "m/s", "velocity of " + texts.of + ", derivative of " + texts.position_source,
      motion.velocity_m_s);
  add("a", "m/s2", "acceleration of " + texts.of + ", " + texts.acceleration_source,
      motion.acceleration_m_s2);
}

}  // namespace

void write_kinematics(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& at,
                      LoadHistory& history) {
  const PointMotion on_circle = circle_of_eccentric(mill, at), pitch = pitch_at_chamber_centre(mill, at);
  PointMotion charge = contains(effects, "charge_lag") ? lagging(on_circle, loss_angle_rad(mill)) : on_circle;
  charge.add(circle_of_charge(mill, at));
  if (contains(effects, "charge_follows_pitch")) charge.add(pitch);
  PointMotion chamber = on_circle;
  chamber.add(pitch);
  write_point({"C", "the chamber's centre", "(1) and the pitch", "replaces (16)"}, chamber, history);
  write_point({"O", "the charge's centre", "(4)", "replaces (27)"}, charge, history);
}

void write_published_kinematics(const VibratoryMill& mill, const Instants& at, LoadHistory& history) {
  const double omega_e = mill.speed_rad_s, omega_r = mill.charge_relative_speed_rad_s;
  const double a_C = omega_e * omega_e * mill.eccentricity_m;       // (16)
  const double a_OC = omega_r * omega_r * mill.charge_offset_m;     // (20)
  const double a_k = 2 * omega_e * omega_r * mill.charge_offset_m;  // (24)
  const PointMotion chamber = circle_of_eccentric(mill, at);
  PointMotion charge = chamber;
  charge.add(circle_of_charge(mill, at));
  charge.acceleration_m_s2 = -a_C * at.along_phi - (a_OC + a_k) * at.along_chi;
  write_point({"C", "the chamber's centre", "(1)", "(16) as a vector"}, chamber, history);
  write_point({"O", "the charge's centre", "(4)", "(27) as a vector, without the term that (15) drops"},
              charge, history);

  const ArrayXd delta = at.phi_rad + pi - at.chi_rad;
  const ArrayXd a_n = -a_C * delta.cos() + a_OC + a_k, a_xi = a_C * delta.sin();
  const auto constant_of = [&](double value) { return ArrayXd::Constant(at.size(), value); };
  auto& q = history.quantities;
  q.push_back({"chi", "rad", "direction of the charge's centre from C, clockwise: phi + pi - delta, (4)",
               at.chi_rad});
  q.push_back({"a_C", "m/s2", "acceleration of the chamber's centre, towards C1, (16)", constant_of(a_C)});
  q.push_back({"a_OC", "m/s2", "acceleration of the charge's centre on its circle, towards C, (20)",
               constant_of(a_OC)});
  q.push_back(
      {"a_k", "m/s2", "Coriolis acceleration of the charge's centre, towards C, (24)", constant_of(a_k)});
  q.push_back({"a_n", "m/s2", "acceleration of the charge's centre, towards C, (25)", a_n});
  q.push_back({"a_xi", "m/s2", "acceleration of the charge's centre, across CO, (26)", a_xi});
  q.push_back({"a_O", "m/s2", "acceleration of the charge's centre, magnitude, (27)",
               (a_n.square() + a_xi.square()).sqrt()});
}

}  // namespace kinetics::vibratory
