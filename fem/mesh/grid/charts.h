/// Curved coordinates of the bodies: formulas only. Internal to fem.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/body.h"

namespace fem {

using Coordinates = std::array<double, 3>;

/// (r, theta, z) of the cylinder before the eccentric shift, theta in [0, 2 pi), from a point (x, y, z). In
/// closed form.
Coordinates pull_back(const CylinderChart& chart, const Coordinates& point);

/// The point (x, y, z) of (r, theta, z).
Coordinates push_forward(const CylinderChart& chart, const Coordinates& chart_point);

/// (distance from the circle of centres, theta, angle) from a point (x, y, z). Angle pi points from the
/// circle towards the z axis, 3 pi / 2 along +z; both angles in [0, 2 pi). An inner fillet stays clear of the
/// branch cut at angle 0.
Coordinates pull_back(const TorusChart& chart, const Coordinates& point);
Coordinates push_forward(const TorusChart& chart, const Coordinates& chart_point);

/// Whether the boundary group is that of a torus.
bool is_fillet(const std::vector<TorusChart>& tori, int boundary_id);

/// @throws std::invalid_argument if a shifted chart has radii out of order or a shift not below their
/// difference
void refuse_impossible(const CylinderChart& chart);

/// @throws std::invalid_argument if the radius is not positive or the centre's radius is negative
void refuse_impossible(const TorusChart& chart);

}  // namespace fem
