/// Forces in the plane, summed with their moments: the tests' own bookkeeping of equilibrium.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace machines {

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Sum of forces and of moments about one point, each with the sum of magnitudes.
class Sum {
public:
  explicit Sum(const Eigen::Vector2d& about) : about_(about) {}
  void add(const Eigen::Vector2d& at, const Eigen::Vector2d& force, double couple = 0) {
    const Eigen::Vector2d arm = at - about_;
    force_ += force;
    force_scale_ += force.norm();
    moment_ += cross(arm, force) + couple;
    moment_scale_ += std::abs(arm.x() * force.y()) + std::abs(arm.y() * force.x()) + std::abs(couple);
  }
  double force() const { return force_.norm() / force_scale_; }
  double moment() const { return std::abs(moment_) / moment_scale_; }

private:
  Eigen::Vector2d about_, force_ = Eigen::Vector2d::Zero();
  double moment_ = 0, force_scale_ = 0, moment_scale_ = 0;
};

}  // namespace machines
