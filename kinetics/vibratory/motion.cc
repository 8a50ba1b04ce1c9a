#include "kinetics/vibratory/motion.h"

#include <cmath>

namespace kinetics::vibratory {
namespace {

const double pi = std::acos(-1.0);

constexpr Eigen::ArrayXd Instants::*members[] = {&Instants::phi_rad,
                                                 &Instants::chi_rad,
                                                 &Instants::speed_rad_s,
                                                 &Instants::acceleration_rad_s2,
                                                 &Instants::relative_speed_rad_s,
                                                 &Instants::relative_acceleration_rad_s2,
                                                 &Instants::theta_rad,
                                                 &Instants::theta_rad_s,
                                                 &Instants::theta_rad_s2};

/// chi when the drive has turned by an angle since its start.
Eigen::ArrayXd charge_direction_rad(const VibratoryMill& mill, const Eigen::ArrayXd& turned_rad) {
  const double start_rad = mill.initial_angle_rad + pi - mill.charge_initial_angle_rad;
  return start_rad + charge_speed_ratio(mill) * turned_rad;
}

}  // namespace

double charge_speed_ratio(const VibratoryMill& mill) {
  return (mill.speed_rad_s + mill.charge_relative_speed_rad_s) / mill.speed_rad_s;
}

Instants steady_at(const VibratoryMill& mill, const Eigen::ArrayXd& phi_rad, const Eigen::ArrayXd& chi_rad) {
  const Eigen::Index n = phi_rad.size();
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(n);
  const Eigen::ArrayXd speed = Eigen::ArrayXd::Constant(n, mill.speed_rad_s);
  const Eigen::ArrayXd relative_speed = Eigen::ArrayXd::Constant(n, mill.charge_relative_speed_rad_s);
  return {phi_rad, chi_rad, speed, zero, relative_speed, zero, zero, zero, zero};
}

Instants steady_instants(const VibratoryMill& mill, const TimeGrid& grid, Eigen::Index first,
                         Eigen::Index count) {
  const Eigen::ArrayXd steps = Eigen::ArrayXd::LinSpaced(count, double(first), double(first + count - 1));
  const Eigen::ArrayXd turned_rad = steps * (2 * pi / grid.instants_per_turn);
  return steady_at(mill, mill.initial_angle_rad + turned_rad, charge_direction_rad(mill, turned_rad));
}

Instants driven_at(const VibratoryMill& mill, const Eigen::ArrayXd& phi_rad,
                   const Eigen::ArrayXd& speed_rad_s, const Eigen::ArrayXd& acceleration_rad_s2) {
  const double relative = mill.charge_relative_speed_rad_s / mill.speed_rad_s;
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(phi_rad.size());
  return {phi_rad,
          charge_direction_rad(mill, phi_rad - mill.initial_angle_rad),
          speed_rad_s,
          acceleration_rad_s2,
          relative * speed_rad_s,
          relative * acceleration_rad_s2,
          zero,
          zero,
          zero};
}

Instants part_of(const Instants& all, Eigen::Index first, Eigen::Index count) {
  Instants part;
  for (const auto member : members) part.*member = (all.*member).segment(first, count);
  return part;
}

Instants every_nth(const Instants& all, Eigen::Index n, Eigen::Index count) {
  Instants some;
  for (const auto member : members) some.*member = (all.*member)(Eigen::seqN(Eigen::Index(0), count, n));
  return some;
}

void append(Instants& all, const Instants& more) {
  for (const auto member : members) {
    Eigen::ArrayXd joined((all.*member).size() + (more.*member).size());
    joined << all.*member, more.*member;
    all.*member = std::move(joined);
  }
}

Eigen::Array2Xd direction(const Eigen::ArrayXd& angle_rad) {
  Eigen::Array2Xd e(2, angle_rad.size());
  e.row(0) = angle_rad.cos().transpose();
  e.row(1) = -angle_rad.sin().transpose();
  return e;
}

Eigen::Array2Xd tangent(const Eigen::ArrayXd& angle_rad) {
  Eigen::Array2Xd n(2, angle_rad.size());
  n.row(0) = -angle_rad.sin().transpose();
  n.row(1) = -angle_rad.cos().transpose();
  return n;
}

Eigen::Array2Xd scaled(const Eigen::ArrayXd& factor, const Eigen::Array2Xd& vectors) {
  return vectors.rowwise() * factor.transpose();
}

Eigen::Array2Xd constant(const Eigen::Vector2d& vector, Eigen::Index n) {
  return vector.array().replicate(1, n);
}

Eigen::Vector2d turned(const Eigen::Vector2d& p) {
  return {-p.y(), p.x()};
}

Eigen::Array2Xd turned(const Eigen::Array2Xd& p) {
  Eigen::Array2Xd q(2, p.cols());
  q.row(0) = -p.row(1);
  q.row(1) = p.row(0);
  return q;
}

Eigen::ArrayXd cross(const Eigen::Array2Xd& a, const Eigen::Array2Xd& b) {
  return (a.row(0) * b.row(1) - a.row(1) * b.row(0)).transpose();
}

Eigen::ArrayXd dot(const Eigen::Array2Xd& a, const Eigen::Array2Xd& b) {
  return (a * b).colwise().sum().transpose();
}

Eigen::Array2Xd translation(const VibratoryMill& mill, const Instants& at) {
  return mill.eccentricity_m * direction(at.phi_rad);
}

Eigen::Array2Xd translation_velocity(const VibratoryMill& mill, const Instants& at) {
  return scaled(mill.eccentricity_m * at.speed_rad_s, tangent(at.phi_rad));
}

Eigen::Array2Xd translation_acceleration(const VibratoryMill& mill, const Instants& at, double shift_rad) {
  const Eigen::ArrayXd angle_rad = at.phi_rad + shift_rad;
  return scaled(mill.eccentricity_m * at.acceleration_rad_s2, tangent(angle_rad)) -
         scaled(mill.eccentricity_m * at.speed_rad_s.square(), direction(angle_rad));
}

}  // namespace kinetics::vibratory
