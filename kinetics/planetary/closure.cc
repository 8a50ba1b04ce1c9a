#include "kinetics/planetary/closure.h"

#include <cmath>

namespace kinetics::planetary {
namespace {

using Eigen::Array2d;
using Eigen::Array2Xd;
using Eigen::ArrayXd;
using Eigen::Index;

/// Sums of forces and of moments about A, with the sums of magnitudes.
class Sums {
public:
  explicit Sums(Index n)
      : force_N_(Array2Xd::Zero(2, n)),
        force_scale_N_(ArrayXd::Zero(n)),
        moment_Nm_(ArrayXd::Zero(n)),
        moment_scale_Nm_(ArrayXd::Zero(n)) {}

  void add(const Array2d& arm_m, const Array2Xd& force_N) {
    force_N_ += force_N;
    force_scale_N_ += force_N.matrix().colwise().norm().transpose().array();
    const ArrayXd first = arm_m.x() * force_N.row(1).transpose();
    const ArrayXd second = arm_m.y() * force_N.row(0).transpose();
    moment_Nm_ += first - second;
    moment_scale_Nm_ += first.abs() + second.abs();
  }
  void add_couple(const ArrayXd& couple_Nm) {
    moment_Nm_ += couple_Nm;
    moment_scale_Nm_ += couple_Nm.abs();
  }
  ArrayXd force() const {
    return relative(force_N_.matrix().colwise().norm().transpose().array(), force_scale_N_);
  }
  ArrayXd moment() const { return relative(moment_Nm_.abs(), moment_scale_Nm_); }

private:
  /// a / b, zero where b is.
  static ArrayXd relative(const ArrayXd& a, const ArrayXd& b) { return (b == 0).select(0.0, a / b); }
  Array2Xd force_N_;
  ArrayXd force_scale_N_, moment_Nm_, moment_scale_Nm_;
};

Array2Xd along(const Array2d& direction, const ArrayXd& size_N) {
  return (direction.matrix() * size_N.matrix().transpose()).array();
}

void add_belt(const Machine& machine, const Tensions& belt, Sums& sums) {
  const PlanetaryGeometry& g = machine.geometry;
  const double r_m = g.drum_pulley_m, s = g.belt_sine, cosine = g.belt_cosine;
  sums.add({r_m * s, -r_m * cosine}, along({-cosine, -s}, belt.T1_N));
  sums.add({r_m * s, r_m * cosine}, along({-cosine, s}, belt.T2_N));
}

}  // namespace

Closure closure(const Machine& machine, const LoadHistory& history, const Tensions* belt) {
  Sums sums(history.n_instants());
  const double alpha = machine.mill.charge.segment_angle_rad;
  const Array2d axis_m = Array2d::Zero();
  const Array2d centroid_m = machine.charge.centroid_m * Array2d(std::sin(alpha), -std::cos(alpha));
  for (const Resultant& resultant : history.resultants)
    if (resultant.role == "trunnions") {
      sums.add(axis_m, resultant.total.topRows<2>());
    } else if (resultant.role == "drum" || resultant.role == "inner_wall") {
      for (const Contribution& part : resultant.contributions)
        sums.add(resultant.role == "drum" ? axis_m : centroid_m, part.load.topRows<2>());
    } else if (resultant.role == "pulley" && !belt) {
      sums.add_couple(resultant.total.row(2).transpose());
    }
  if (belt) add_belt(machine, *belt, sums);
  return {sums.force(), sums.moment()};
}

}  // namespace kinetics::planetary
