/// Plane sections and surface rings of a body: what the recovered stress says about them. Internal to fem.
#pragma once

#include <array>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"
#include "fem/mesh/grid/grid.h"

namespace fem {

/// sigma_r_theta and sigma_theta_z at a point (x, y) from an axis along z; stress xx, yy, zz, xy, yz, xz.
std::array<double, 2> rim_shear(double x_m, double y_m, const double* stress_Pa);

/// What each node counts in a mean over a circle, where locally refined bodies have nodes at unlike
/// distances: about half the angle between its neighbours, over the whole turn, so that as many harmonics as
/// can be, up to the twelfth, have no mean.
/// @return nothing where nodes are farther apart than a quarter of the turn: they are on a part of the circle
/// @param angles_rad  any order
std::vector<double> weights_around(const std::vector<double>& angles_rad);

/// Fills planes, plane_area_m2 and sections from displacement and stress.
/// @throws std::invalid_argument for a plane that no cell faces lie in, or that they do not fill, or without
/// rim nodes
void respond_on_sections(const Grid& grid, const std::vector<SectionPlane>& planes, UnitResponses& responses);

/// Fills rings and ring_shear_Pa: nodes of curved boundary faces whose chart has no shift, and of fillets.
/// Locally refined bodies have only circles with nodes all around.
void respond_on_rings(const Grid& grid, const Body& body, UnitResponses& responses);

}  // namespace fem
