/// What fem needs to know of a body, as values: cells, surface charts, material. No deal.II in this header.
/// Lengths in m; ids are those of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fem/base/values/coarse_mesh.h"
#include "fem/base/values/unit_load.h"

namespace fem {

/// Isotropic linear elasticity.
struct Material {
  double youngs_modulus_Pa = 0;
  double poisson_ratio = 0;
  double density_kg_m3 = 0;
};

/// Cells of the volume group: cylinder coordinates about the axis through (axis_x, axis_y) parallel to z,
/// composed with the eccentric shift
/// (x, y) += clamp((r - inner_radius) / (outer_radius - inner_radius), 0, 1) (shift_x, shift_y).
struct CylinderChart {
  int volume_id = 0;
  double shift_x_m = 0, shift_y_m = 0;
  double inner_radius_m = 0, outer_radius_m = 0;
  double axis_x_m = 0, axis_y_m = 0;
};

/// Faces of the boundary group: torus about z, a circle of `radius` about (z, r) = (centre_z, centre_radius).
struct TorusChart {
  int boundary_id = 0;
  double centre_z_m = 0, centre_radius_m = 0, radius_m = 0;
};

/// Nodes of the boundary group without displacement in the fixed directions (x, y, z). Clamps are ideal: a
/// surface held in a way the body feels (a line, the rim of a face) makes stress infinite there.
struct Clamp {
  int boundary_id = 0;
  std::array<bool, 3> fixed = {true, true, true};
  std::optional<double> only_at_z_m{};  ///< holds the group's nodes at this height only: a line
};

/// Hexahedra cut into eight at once.
struct RefinementCycle {
  std::vector<std::int32_t> cells;  ///< indices in the mesh before (Nodes::cells of a model of that)
  /// Then all cells with a vertex at one of these points are cut, pieces of these among them: nodes of
  /// the mesh before.
  std::vector<std::array<double, 3>> again_at_m{};
};

inline bool operator==(const RefinementCycle& a, const RefinementCycle& b) {
  return a.cells == b.cells && a.again_at_m == b.again_at_m;
}

struct Body {
  /// Linear hexahedra, or quadratic tetrahedra (no charts, degree 2). Shared: many bodies are made of one
  /// mesh.
  std::shared_ptr<const CoarseMesh> mesh;
  std::vector<CylinderChart> cylinders;
  std::vector<TorusChart> tori;
  Material material;
  std::vector<ElasticSupport> elastic_supports;
  /// One after the other. More cells are cut where neighbours would differ by more than one halving of edges.
  std::vector<RefinementCycle> refinements{};
  int degree = 2;  ///< polynomial degree of displacement and of the geometry (isoparametric), 1 to 3
  /// None: a free body, whose loads inertia balances. Otherwise they hold all six rigid motions.
  std::vector<Clamp> clamps{};
};

/// Mass, first moment and inertia of the meshed body by the quadrature of its load vectors, about the origin.
struct MassProperties {
  double volume_m3 = 0;
  double mass_kg = 0;
  std::array<double, 3> first_moment_kg_m{};  ///< m * centre of mass
  std::array<double, 6>
      second_moments_kg_m2{};  ///< integrals of rho xx, yy, zz, xy, yz, xz (polar inertia J = xx + yy)
};

}  // namespace fem
