/// The direction of stress deviators along which counted cycles damage most.
///
/// Rainflow counts a scalar. Along one direction all cycles across it are shortened by their cosine, so that
/// a load that turns the largest cycle away from smaller ones would lengthen the life. Cycles are therefore
/// counted along several directions, and the worst one counts: the maximum-damage criterion, as
/// critical-plane methods take it over planes (Bannantine and Socie 1991; Socie and Marquis, Multiaxial
/// Fatigue, 2000, ch. 5). Here it is taken over directions of the five-dimensional deviator space.
#pragma once

#include <functional>
#include <vector>

#include "pipelines/superpose/between_instants/stress_course.h"

namespace pipelines {

/// What counting along a direction comes to; any measure that grows with damage.
using DamageAlong = std::function<double(const DeviatoricDirection&)>;

/// Directions to count along, of which one is the worst to some percent of its damage: the largest cycle's;
/// the widest ones across those before, until no range is left above a twentieth of the largest; and from the
/// worst of these and of the middles of any two, what small turns towards each of the others make worse, down
/// to 1/200 rad. Without a direction where nothing changes.
/// @param coordinates  5 x places (StressCourse::coordinates)
/// @param largest      direction of the largest cycle
std::vector<DeviatoricDirection> damage_directions(
    const Eigen::Matrix<double, 5, Eigen::Dynamic>& coordinates, const DeviatoricDirection& largest,
    const DamageAlong& damage);

/// The direction near one from which no small turn makes the damage larger, by Newton's method on its
/// logarithm: there turning changes it in second order only. Damage jumps where other turning points pair up
/// to equal ranges with unlike means. The largest one may lie at such an edge; then what is returned is the
/// worst of those that the method came past, at least as bad as the given one.
/// @param damage  positive at the given one
DeviatoricDirection stationary_direction(const DeviatoricDirection& near, const DamageAlong& damage);

}  // namespace pipelines
