/// The six rigid motions of nodes with a share of the volume each: taken out of forces and of displacements.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

class RigidPart {
public:
  /// @param nodes  outlives this object
  /// @param volume_m3  volume of each node
  RigidPart(const fem::Nodes& nodes, std::vector<double> volume_m3);

  /// Subtracts the rigid-mode body force with the same resultants.
  /// @param force  n x 3
  /// @return the moment taken out, over the sum of |f| times the distance from the centre of volume
  double remove_resultants(double* force) const;

  /// Subtracts the rigid motion that is closest in the norm below.
  /// @param displacement  n x 3
  void remove_motion(double* displacement) const;

  /// sqrt(sum of volume |u|^2), for volumes that are positive (fem::nodal_volumes_m3)
  double norm(const double* displacement) const;

private:
  using Modes = Eigen::Matrix<double, 3, 6>;
  Eigen::Vector3d position(std::size_t node) const;
  /// Displacement of a node under unit translations, and rotations about the centre.
  Modes modes(std::size_t node) const;

  const fem::Nodes& nodes_;
  std::vector<double> volume_m3_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 6> inverse_;
};

}  // namespace pipelines
