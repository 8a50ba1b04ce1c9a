#include "pipelines/scene/values/contact_arc.h"

#include <cmath>
#include <stdexcept>

#include "pipelines/base/common/constants.h"

namespace pipelines {

double half_arc_rad(const ConformingContact& contact) {
  if (!(contact.radius_m > 0) || !(contact.clearance_m >= 0) || !(contact.force_N_m > 0) ||
      !(contact.plane_modulus_Pa > 0))
    throw std::invalid_argument(
        "contact of a cylinder in a hole: radius, force and modulus must be above 0, the "
        "clearance not below");
  const double stiffness = (contact.hub_is_stiff ? 2 : 1) * contact.plane_modulus_Pa;
  const double wanted = stiffness * contact.clearance_m / 2 / contact.force_N_m;
  // The left side less the right one, times pi x (x + 1): falls from 2 with x, to below zero at x = 1.
  const auto rest = [&](double x) { return 2 - std::log1p(x) - 2 * x * x - wanted * pi * x * (x + 1); };
  double low = 0, high = 1;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (rest(middle) > 0 ? low : high) = middle;
  }
  return 2 * std::atan(std::sqrt(high));
}

}  // namespace pipelines
