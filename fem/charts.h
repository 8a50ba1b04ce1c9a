/// Curved coordinates of the bodies, and their attachment to a mesh as deal.II manifolds. Internal to fem.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

#include "fem/body.h"

namespace fem {

/// (r, theta, z) of the cylinder before the eccentric shift of a CylinderChart; theta in [0, 2 pi), periodic.
class EccentricCylinder final : public dealii::ChartManifold<3, 3, 3> {
public:
  /// @throws std::invalid_argument if a shifted chart has radii out of order or a shift not below their difference
  explicit EccentricCylinder(const CylinderChart& chart);
  std::unique_ptr<dealii::Manifold<3, 3>> clone() const override;
  dealii::Point<3> pull_back(const dealii::Point<3>& point) const override;
  dealii::Point<3> push_forward(const dealii::Point<3>& chart_point) const override;

private:
  CylinderChart chart_;
};

/// (distance from the circle of centres, theta, angle): angle pi points from the circle's centre to the z axis,
/// 3 pi / 2 along +z; in [0, 2 pi), periodic, as theta. An inner fillet stays clear of the branch cut.
class Torus final : public dealii::ChartManifold<3, 3, 3> {
public:
  /// @throws std::invalid_argument if the radius is not positive or the centre's radius is negative
  explicit Torus(const TorusChart& chart);
  std::unique_ptr<dealii::Manifold<3, 3>> clone() const override;
  dealii::Point<3> pull_back(const dealii::Point<3>& point) const override;
  dealii::Point<3> push_forward(const dealii::Point<3>& chart_point) const override;

private:
  TorusChart chart_;
};

/// Gives every cell, face and edge its manifold, in an order that depends on ids only: all flat; then the cells of each
/// cylinder chart with their faces and edges, by ascending volume id (charts agree on what they share: the concentric
/// part); then the faces of each fillet with their edges, by ascending boundary id.
/// @throws std::invalid_argument if a chart's volume or a torus' boundary group is not in the mesh
void attach_charts(dealii::Triangulation<3>& mesh, std::vector<CylinderChart> cylinders, std::vector<TorusChart> tori);

}  // namespace fem
