#include "pipelines/loads/channels/rigid_part.h"

#include <cmath>
#include <utility>

namespace pipelines {

RigidPart::RigidPart(const fem::Nodes& nodes, std::vector<double> volume_m3)
    : nodes_(nodes), volume_m3_(std::move(volume_m3)) {
  double volume = 0;
  for (std::size_t i = 0; i < nodes.n; ++i) {
    volume += volume_m3_[i];
    centre_ += volume_m3_[i] * position(i);
  }
  centre_ /= volume;
  Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t i = 0; i < nodes.n; ++i) inertia += volume_m3_[i] * modes(i).transpose() * modes(i);
  inverse_ = inertia.inverse();
}

double RigidPart::remove_resultants(double* force) const {
  Eigen::Matrix<double, 6, 1> resultant = Eigen::Matrix<double, 6, 1>::Zero();
  double scale = 0;
  for (std::size_t i = 0; i < nodes_.n; ++i) {
    const Eigen::Map<const Eigen::Vector3d> f(force + 3 * i);
    resultant += modes(i).transpose() * f;
    scale += f.norm() * (position(i) - centre_).norm();
  }
  const Eigen::Matrix<double, 6, 1> acceleration = inverse_ * resultant;
  for (std::size_t i = 0; i < nodes_.n; ++i)
    Eigen::Map<Eigen::Vector3d>(force + 3 * i) -= volume_m3_[i] * modes(i) * acceleration;
  return scale > 0 ? resultant.tail<3>().norm() / scale : 0;
}

void RigidPart::remove_motion(double* displacement) const {
  Eigen::Matrix<double, 6, 1> momentum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < nodes_.n; ++i)
    momentum +=
        volume_m3_[i] * modes(i).transpose() * Eigen::Map<const Eigen::Vector3d>(displacement + 3 * i);
  const Eigen::Matrix<double, 6, 1> motion = inverse_ * momentum;
  for (std::size_t i = 0; i < nodes_.n; ++i)
    Eigen::Map<Eigen::Vector3d>(displacement + 3 * i) -= modes(i) * motion;
}

double RigidPart::norm(const double* displacement) const {
  double sum = 0;
  for (std::size_t i = 0; i < nodes_.n; ++i)
    sum += volume_m3_[i] * Eigen::Map<const Eigen::Vector3d>(displacement + 3 * i).squaredNorm();
  return std::sqrt(sum);
}

Eigen::Vector3d RigidPart::position(std::size_t node) const {
  return {nodes_.xyz_m[3 * node], nodes_.xyz_m[3 * node + 1], nodes_.xyz_m[3 * node + 2]};
}

RigidPart::Modes RigidPart::modes(std::size_t node) const {
  const Eigen::Vector3d r = position(node) - centre_;
  Modes result;
  result.leftCols<3>().setIdentity();
  result.rightCols<3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return result;
}

}  // namespace pipelines
