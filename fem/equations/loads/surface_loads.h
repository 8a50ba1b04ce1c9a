/// Load vectors of surfaces and of body forces. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_load.h"
#include "fem/mesh/grid/grid.h"
#include "fem/mesh/grid/rigid_modes.h"

namespace fem {

/// A surface and its six exact unit resultants (fx, fy, fz, mx, my, torque about the surface's centre).
class LoadedSurface {
public:
  /// @throws std::invalid_argument if the group has no faces, or the sizes of the surface are not positive
  /// @throws MeshUnusable if its faces cannot carry six independent resultants
  LoadedSurface(const Grid& grid, const LoadSurface& surface);

  const LoadSurface& surface() const noexcept { return surface_; }
  const std::vector<std::int32_t>& nodes() const noexcept { return nodes_; }

  /// Forces on the surface's nodes: row 3 i + d belongs to component d of nodes()[i]. Here a unit resultant.
  Eigen::VectorXd resultant(SurfaceResultant::Component component) const;

  /// Harmonic of the seat pressure without its discrete resultants, unless it keeps them; `load.surface` is
  /// this one.
  /// @throws std::invalid_argument for harmonic 1 or a negative one, the sine of harmonic 0, or a face
  Eigen::VectorXd pressure(const SeatPressure& load) const;

  /// The same forces as a column of the body's unknowns (3 n_nodes).
  Eigen::VectorXd on_body(const Eigen::VectorXd& force) const;

  /// The traction whose forces on the whole surface are resultant() or pressure(), on the faces of the group
  /// that a part of the body has: a column of the part's unknowns (3 n_nodes). Its cells may be cut.
  Eigen::VectorXd resultant_on(const Grid& part, SurfaceResultant::Component component) const;
  Eigen::VectorXd pressure_on(const Grid& part, const SeatPressure& load) const;

private:
  using Traction =
      std::function<Eigen::Vector3d(const Eigen::Vector3d& local, const Eigen::Vector3d& normal)>;
  Eigen::VectorXd integrate(const Traction& traction) const;
  Eigen::VectorXd integrate_on(const Grid& part, const Traction& traction) const;
  Traction pressure_of(const SeatPressure& load) const;
  Traction sum_of_raw(const Eigen::VectorXd& shares) const;
  Eigen::MatrixXd about_centre(const Eigen::MatrixXd& force) const;  // 6 x columns

  const Grid* grid_;
  LoadSurface surface_;
  std::vector<BoundaryFace> faces_;
  std::vector<std::int32_t> nodes_;
  std::vector<Traction> raw_;  // six, whose resultants are about right
  Eigen::MatrixXd shares_;     // 6 x 6: of the raw tractions (rows) in the unit resultants
  Eigen::MatrixXd basis_;      // 3 n x 6
};

/// Whether two loads act on the same surface, so that one LoadedSurface serves both.
bool same_surface(const LoadSurface& a, const LoadSurface& b);

/// Body force on all nodes (3 n_nodes); `integrals` over the cells it acts on.
Eigen::VectorXd body_force(const NodeIntegrals& integrals, double density_kg_m3, BodyForce::Field field);

/// @throws std::invalid_argument for an empty list, an empty or repeated channel
void check_channels(const std::vector<UnitLoad>& loads);

/// All load vectors as applied, one column per load.
/// @throws std::invalid_argument for an empty list, an empty or repeated channel, a body force on a volume
/// group without cells, and as LoadedSurface, naming the channel
Eigen::MatrixXd load_vectors(const Grid& grid, const NodeIntegrals& integrals, double density_kg_m3,
                             const std::vector<UnitLoad>& loads);

/// Unit resultants of a surface as columns (3 n_nodes x 6), in the order of SurfaceResultant::Component.
Eigen::MatrixXd unit_resultants(const Grid& grid, const LoadSurface& surface);

/// Where a load enters; null for a body force.
const LoadSurface* surface_of(const UnitLoad& load);

/// Boundary groups that any of the loads, springs or clamps acts on.
std::vector<int> loaded_groups(const std::vector<UnitLoad>& loads, const Body& body);

}  // namespace fem
