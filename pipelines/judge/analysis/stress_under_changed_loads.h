/// Stress under loads that differ from those of an analysis: superposed anew at the few points that can
/// matter, not at all of them.
///
/// Von Mises stress is a norm of the stress tensor, and stress is linear in the channels. So a change D_k(t)
/// of the channels moves the stress of a point by at most the sum over k of max |D_k| sigma_v(S_k), which
/// needs no walk through the instants. Points are taken in the order of what they can reach by that sum,
/// until the next one cannot lead any more.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// Largest von Mises stresses of a body over points and instants [Pa].
struct LargestStresses {
  double peak_Pa = 0;      ///< outside the exclusion distances
  double hot_spot_Pa = 0;  ///< extrapolated to a weld toe; 0: the body has none
};

/// Those that the analysis has.
LargestStresses largest_stresses(const Judged& analysis);

/// Stress that a point may have besides, from the unit stresses of its channels: K times (xx, yy, zz, xy, yz,
/// xz), as UnitResponses::stress_Pa has them for a node [Pa].
using MoreStress = std::function<double(const double* unit)>;

/// The same under the analysis' loads plus a change.
/// @param change  K x instants, in the order of the analysis' channels
LargestStresses largest_under(const Judged& analysis, const Eigen::ArrayXXd& change);

/// Upper bound of what the stresses become by a change, whatever its sign: the largest of every point's own
/// stress plus the largest von Mises stress of the change there, plus `more`.
LargestStresses bound_under(const Judged& analysis, const Eigen::ArrayXXd& change, const MoreStress& more);

/// Largest von Mises stress over the instants of unit stresses times factors (K x instants) [Pa].
double largest_von_mises_Pa(const double* unit, const Eigen::ArrayXXd& factors);

}  // namespace pipelines
