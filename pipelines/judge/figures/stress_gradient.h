/// The slope of a stress below the surface, which fatigue's support factor asks for.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

/// Cells and faces around nodes of a surface: found once for many gradients.
class SurfaceSlopes {
public:
  /// @param nodes  outlive this
  explicit SurfaceSlopes(const fem::Nodes& nodes);

  /// G = -(1/f) df/dn at a node of the surface, n pointing inwards [1/m]: by how much of itself a field falls
  /// per length below the surface (the related stress gradient of FKM and DIN 743). Of hexahedra the mean of
  /// what the cells around interpolate there; cells of degree 1, whose slope is that of their middle, with
  /// the change to the next row. To the nodes of tetrahedra around a quadratic is fitted (a plane where a
  /// quadratic is not determined). It is as good as the recovered values there.
  /// @param field  at any node; positive at this one
  /// @return not negative: a field that rises inwards has no support; zero where no cells are around
  double related_gradient_per_m(std::size_t node, const std::function<double(std::size_t)>& field) const;

  /// df/dn at a node of the surface, n pointing inwards, is the sum of weight (f(other) - f(node)) over its
  /// neighbours [1/m]; none where no cells or faces are around. A node of a body of revolution that was moved
  /// to the crest between half planes has the stress of that place, and the slope at the next node of its
  /// circle: the field is not known below it.
  std::vector<std::pair<std::size_t, double>> inward_weights(std::size_t node) const;

  /// Mean direction of the faces around a node of the surface, outwards, of length one; zero where there are
  /// none.
  std::array<double, 3> outward_normal(std::size_t node) const;

private:
  /// The next node on the circle around the z axis of a node that was moved; the node itself: there is none.
  std::size_t stand_in(std::size_t node) const;

  using Weights = std::map<std::size_t, double>;
  Weights weights_by_cells(std::size_t node, const Eigen::Vector3d& direction) const;
  /// The node of the cells around that lies most nearly inwards and its distance [m], without those beside
  /// `before`; the node itself where there is none within 45 degrees.
  std::pair<std::size_t, double> next_inwards(std::size_t node, std::size_t before,
                                              const Eigen::Vector3d& inward) const;
  std::vector<std::pair<std::size_t, double>> weights_of_hexahedra(std::size_t node,
                                                                   const Eigen::Vector3d& inward) const;
  std::vector<std::pair<std::size_t, double>> weights_of_tetrahedra(std::size_t node,
                                                                    const Eigen::Vector3d& inward) const;

  const fem::Nodes* nodes_;
  std::vector<std::vector<std::int32_t>> cells_of_, faces_of_;  // by node
};

}  // namespace pipelines
