#include "kinetics/vibratory_effects/motion.h"

#include <Eigen/Geometry>
#include <cmath>

#include "kinetics/values/constants.h"

namespace kinetics::vibratory {
namespace {

constexpr Eigen::ArrayXd Instants::*members[] = {&Instants::phi_rad,
                                                 &Instants::chi_rad,
                                                 &Instants::speed_rad_s,
                                                 &Instants::acceleration_rad_s2,
                                                 &Instants::relative_speed_rad_s,
                                                 &Instants::relative_acceleration_rad_s2,
                                                 &Instants::theta_rad,
                                                 &Instants::theta_rad_s,
                                                 &Instants::theta_rad_s2};

constexpr Eigen::Array2Xd Instants::*directions[] = {&Instants::along_phi, &Instants::along_chi};

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
  for (const auto e : directions) part.*e = (all.*e).middleCols(first, count);
  return part;
}

Instants every_nth(const Instants& all, Eigen::Index n, Eigen::Index count) {
  Instants some;
  const auto every = Eigen::seqN(Eigen::Index(0), count, n);
  for (const auto member : members) some.*member = (all.*member)(every);
  for (const auto e : directions) some.*e = (all.*e)(Eigen::all, every);
  return some;
}

void append(Instants& all, const Instants& more) {
  for (const auto member : members) {
    Eigen::ArrayXd joined((all.*member).size() + (more.*member).size());
    joined << all.*member, more.*member;
    all.*member = std::move(joined);
  }
  for (const auto e : directions) {
    Eigen::Array2Xd joined(2, (all.*e).cols() + (more.*e).cols());
    joined << all.*e, more.*e;
    all.*e = std::move(joined);
  }
}

Eigen::Array2Xd direction(const Eigen::ArrayXd& angle_rad) {
  Eigen::Array2Xd e(2, angle_rad.size());
  for (Eigen::Index i = 0; i < angle_rad.size(); ++i) {
    const double a = angle_rad[i], cosine = std::cos(a), sine = std::sin(a);  // one call of sincos
    e.col(i) << cosine, -sine;
  }
  return e;
}

Eigen::Array2Xd composed(const Eigen::ArrayXd& along, const Eigen::ArrayXd& across,
                         const Eigen::Array2Xd& e) {
  Eigen::Array2Xd vectors(2, e.cols());
  for (Eigen::Index i = 0; i < e.cols(); ++i) {
    vectors(0, i) = along[i] * e(0, i) + across[i] * e(1, i);
    vectors(1, i) = along[i] * e(1, i) - across[i] * e(0, i);
  }
  return vectors;
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

Eigen::ArrayXd cross(const Eigen::Array2Xd& a, const Eigen::Array2Xd& b) {
  return (a.row(0) * b.row(1) - a.row(1) * b.row(0)).transpose();
}

Eigen::Array2Xd translation(const VibratoryMill& mill, const Instants& at) {
  return mill.eccentricity_m * at.along_phi;
}

Eigen::Array2Xd translation_velocity(const VibratoryMill& mill, const Instants& at) {
  return composed(Eigen::ArrayXd::Zero(at.size()), mill.eccentricity_m * at.speed_rad_s, at.along_phi);
}

Eigen::Array2Xd translation_acceleration(const VibratoryMill& mill, const Instants& at, double shift_rad) {
  Eigen::Array2Xd acceleration_m_s2 = composed(-mill.eccentricity_m * at.speed_rad_s.square(),
                                               mill.eccentricity_m * at.acceleration_rad_s2, at.along_phi);
  if (shift_rad == 0) return acceleration_m_s2;
  return (Eigen::Rotation2Dd(-shift_rad).toRotationMatrix() * acceleration_m_s2.matrix()).array();
}

}  // namespace kinetics::vibratory
