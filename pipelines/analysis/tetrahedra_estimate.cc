#include "pipelines/analysis/tetrahedra_estimate.h"

#include <algorithm>
#include <cmath>

#include "fem/stress/tetrahedra_error.h"
#include "fem/submodel/submodel.h"

namespace pipelines {

ErrorEntry tetrahedra_estimate(const StressPoint& point, const fem::UnitResponses& responses,
                               const fem::Material& material, const std::vector<double>& factors) {
  double sum_Pa = 0;
  for (const auto& part : point.parts) {
    const auto [stress_Pa, off_Pa] = fem::cells_against_recovered(responses, material, part.node, factors);
    if (off_Pa == 0) continue;
    const double d = off_Pa / std::max(stress_Pa, off_Pa);
    sum_Pa += std::abs(part.weight) * off_Pa *
              std::max(tetrahedra_factor * std::pow(d, tetrahedra_exponent - 1), tetrahedra_least_share);
  }
  return {"discretisation", tetrahedra_method, sum_Pa, 1};
}

double submodel_error_Pa(const StressPoint& point, const fem::UnitResponses& responses,
                         const fem::Material& material, const BodyLoads& loads,
                         const std::vector<char>& left_out) {
  const Eigen::ArrayXd column = loads.history.values.col(point.instant);
  const std::vector<double> factors(column.begin(), column.end());
  const std::size_t node = point.parts.at(0).node;
  const double value_Pa = von_mises_of(unit_stress_at(responses, point), column);
  const auto largest_Pa = [&](int n_layers, int n_cuts) {
    return fem::submodel_stress(responses, material, loads.unit_loads, node, factors, left_out,
                                {n_layers, n_cuts})
        .largest_Pa;
  };
  const double coarse_Pa = largest_Pa(2, 1), fine_Pa = largest_Pa(2, 2), wide_Pa = largest_Pa(3, 1);
  return 1.5 * std::abs(fine_Pa - value_Pa) + std::abs(fine_Pa - coarse_Pa) + std::abs(wide_Pa - coarse_Pa);
}

}  // namespace pipelines
