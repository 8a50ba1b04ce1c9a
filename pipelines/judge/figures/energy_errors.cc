#include "pipelines/judge/figures/energy_errors.h"

#include <algorithm>
#include <cmath>

namespace pipelines {

EnergyErrors energy_errors(const fem::EnergyError& channels, const Eigen::ArrayXXd& factors) {
  EnergyErrors errors;
  const std::size_t n = channels.norm_sqrtJ.size();
  if (n == 0) return errors;
  std::vector<double> at(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    at[k] = 1;
    errors.channels.push_back(fem::energy_norms(channels, at).relative());
    at[k] = 0;
  }
  double error_sqrtJ = 0, stress_sqrtJ = 0;
  for (Eigen::Index t = 0; t < factors.cols(); ++t) {
    Eigen::Map<Eigen::ArrayXd>(at.data(), factors.rows()) = factors.col(t);
    const auto now = fem::energy_norms(channels, at);
    error_sqrtJ = std::max(error_sqrtJ, now.error_sqrtJ);
    stress_sqrtJ = std::max(stress_sqrtJ, std::hypot(now.solution_sqrtJ, now.error_sqrtJ));
  }
  errors.over_cycle = stress_sqrtJ > 0 ? error_sqrtJ / stress_sqrtJ : 0;
  return errors;
}

}  // namespace pipelines
