/// The slope of a stress below the surface, which fatigue's support factor asks for.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "fem/values/unit_responses.h"

namespace pipelines {

/// Cells and faces around nodes of a surface: found once for many gradients.
class SurfaceSlopes {
public:
  /// @param nodes  outlive this
  explicit SurfaceSlopes(const fem::Nodes& nodes);

  /// G = -(1/f) df/dn at a node of the surface, n pointing inwards [1/m]: by how much of itself a field falls
  /// per length below the surface (the related stress gradient of FKM and DIN 743). A quadratic is fitted to
  /// the field at the nodes of the cells around (a plane where a quadratic is not determined), so it is as
  /// good as their recovered values.
  /// @param field  at any node; positive at this one
  /// @return not negative: a field that rises inwards has no support; zero where no cells are around
  double related_gradient_per_m(std::size_t node, const std::function<double(std::size_t)>& field) const;

  /// df/dn at a node of the surface, n pointing inwards, is the sum of weight (f(other) - f(node)) over its
  /// neighbours [1/m]; none where no cells or faces are around.
  std::vector<std::pair<std::size_t, double>> inward_weights(std::size_t node) const;

  /// Of the faces around a node of the surface, outwards, of length one; zero where there are none.
  std::array<double, 3> outward_normal(std::size_t node) const;

private:
  const fem::Nodes* nodes_;
  std::vector<std::vector<std::int32_t>> cells_of_, faces_of_;  // by node
};

}  // namespace pipelines
