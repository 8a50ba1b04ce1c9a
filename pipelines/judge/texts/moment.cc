#include "pipelines/judge/texts/moment.h"

#include <cmath>

#include "pipelines/base/common/constants.h"

namespace pipelines {

Moment moment_of(const Scene& scene, const kinetics::LoadHistory& loads, Eigen::Index instant) {
  return moment_between(scene, loads, double(instant));
}

Moment moment_between(const Scene& scene, const kinetics::LoadHistory& loads, double instant) {
  const auto before = Eigen::Index(instant);
  const double step = loads.phi_rad.size() > 1 ? loads.phi_rad[1] - loads.phi_rad[0] : 0;
  const double phi = loads.phi_rad[before] + (instant - double(before)) * step;
  double angle = std::remainder(phi - pi, 2 * pi) + pi;
  if (angle > 2 * pi - 1e-9) angle = 0;  // a whole turn that rounding leaves short of itself
  return {int(before / scene.sampling.instants_per_turn) + 1, angle};
}

}  // namespace pipelines
