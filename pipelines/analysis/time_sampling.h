/// What a stress may exceed its value at the instants of the load history, between them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace pipelines {

/// By how much von Mises exceeds its value at an instant, up to both neighbours. The larger of two estimates:
/// a parabola through the three values, and the stress of the load channels between the instants. The
/// parabola alone fails where few instants meet the size of a stress that turns its sign: a load that turns
/// around a shaft in four instants has the same size at all of them. The channels themselves are smooth; they
/// are interpolated over the cycle, which is periodic, by its trigonometric polynomial (below 16 instants) or
/// by polynomials through eight of them.
/// @param unit    per channel (xx, yy, zz, xy, yz, xz) [Pa]
/// @param values  channels x instants
double time_sampling_error_Pa(const std::vector<std::array<double, 6>>& unit, const Eigen::ArrayXXd& values,
                              Eigen::Index instant);

}  // namespace pipelines
