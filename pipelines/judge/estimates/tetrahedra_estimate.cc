#include "pipelines/judge/estimates/tetrahedra_estimate.h"

#include <algorithm>
#include <cmath>

#include "fem/stress/cells/tetrahedra_error.h"
#include "pipelines/judge/estimates/fitted.h"

namespace pipelines {

ErrorEntry tetrahedra_estimate(const StressPoint& point, const fem::UnitResponses& responses,
                               const fem::Material& material, const std::vector<double>& factors) {
  double sum_Pa = 0;
  for (const auto& part : point.parts) {
    const auto [stress_Pa, off_Pa] = fem::cells_against_recovered(responses, material, part.node, factors);
    if (off_Pa == 0) continue;
    const double d = off_Pa / std::max(stress_Pa, off_Pa);
    sum_Pa += std::abs(part.weight) * off_Pa *
              std::max(fitted::tetrahedra_factor * std::pow(d, fitted::tetrahedra_exponent - 1),
                       fitted::tetrahedra_least_share);
  }
  return {"discretisation", tetrahedra_method, sum_Pa, 1};
}

}  // namespace pipelines
