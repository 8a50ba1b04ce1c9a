/// The cycle of a stress history that fatigue counts first: the two instants whose stresses differ most.
///
/// The equivalent amplitude is half of the von Mises stress of that difference (the range of ASME VIII
/// division 2, 5.5.3: component by component, then von Mises). It does not depend on axes, nor on a sign that
/// is given to von Mises stress: alternating torsion counts whole, where a sign by principal stress flips
/// with rounding.
#pragma once

#include <Eigen/Core>

#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {

/// A cycle of the stress at a place. Its fields have no value until they are given one: each thread writes
/// its own of hundreds of thousands, once.
struct StressCycle {
  Eigen::Index from, to;  ///< instants, from < to; equal where the stress never changes
  Stress half_range_Pa;   ///< (s(to) - s(from)) / 2, by component
  Stress mean_Pa;         ///< (s(to) + s(from)) / 2
  double amplitude_Pa;    ///< von Mises stress of half_range_Pa
  double signed_mean_Pa;  ///< signed_von_mises_Pa of mean_Pa
};

/// Von Mises stress with a sign: v where the sum of the three normal stresses is not negative, -v where it is
/// -v or less (compression along one axis or more), in between v + 2 times the sum. So pure shear is
/// positive, and little compression beside it earns little: a mean that is not known to close cracks opens
/// them.
double signed_von_mises_Pa(const Stress& stress);

/// Derivatives of signed_von_mises_Pa by the six components, where each shear component stands for both in
/// the tensor; zeros without von Mises stress.
Stress signed_von_mises_slopes(const Stress& stress);

/// The largest cycle: no pair of instants differs more, but for the slack. Of equal ones that which is found
/// first from the instant of the largest von Mises stress.
/// @param stress_Pa  6 x instants (xx, yy, zz, xy, yz, xz), at least one instant
/// @param slack      share by which another pair may differ more. Zero looks at all pairs where instants lie
/// on
///                   a circle, as in rotating bending; a millionth at next to none
StressCycle largest_cycle(const Eigen::ArrayXXd& stress_Pa, double slack = 0);

/// The cycle between two given instants.
StressCycle cycle_between(const Stress& from, const Stress& to, Eigen::Index first, Eigen::Index second);

}  // namespace pipelines
