#include "fem/equations/loads/balanced_loads.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fem {

Eigen::RowVectorXd to_unit_size(const Eigen::MatrixXd& force) {
  Eigen::RowVectorXd scale = Eigen::RowVectorXd::Ones(force.cols());
  for (Eigen::Index k = 0; k < force.cols(); ++k) {
    const double largest = force.col(k).lpNorm<Eigen::Infinity>();
    if (largest > 0 && std::isfinite(largest))
      scale[k] = std::ldexp(1.0, std::max(-1000, std::min(1000, -std::ilogb(largest))));
  }
  return scale;
}

BalancedLoads balance(const RigidBalance& rigid, const std::vector<std::int64_t>& clamped,
                      Eigen::MatrixXd force) {
  BalancedLoads loads;
  loads.clamped = clamped;
  loads.norm = force.colwise().norm().cwiseMax(1e-300);
  loads.largest_entry = force.colwise().lpNorm<Eigen::Infinity>().cwiseMax(1e-300);
  if (clamped.empty()) rigid.balance(force);
  loads.force = std::move(force);
  return loads;
}

}  // namespace fem
