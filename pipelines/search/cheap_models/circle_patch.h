/// The solution of a body of revolution between the nodes of three circles side by side on its surface.
/// Internal to the runs on this model.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace pipelines {

/// The first node of the circle that a node lies on: n_angles nodes one after the other, the first at +x; on
/// the axis the node itself.
std::size_t first_of_circle(const fem::Nodes& nodes, std::size_t node, int n_angles);

/// A place between the circles: metres along the chords from the second circle towards the third (negative:
/// towards the first), and the angle about the axis.
struct PatchLocation {
  double along_m = 0, angle_rad = 0;
};

/// Components about the axis are trigonometric polynomials of the angle through the nodes of a circle, and
/// parabolas along the surface.
class CirclePatch {
public:
  /// @param circles  first nodes of three circles that follow each other on the surface
  CirclePatch(const fem::UnitResponses& responses, int n_angles, const std::array<std::size_t, 3>& circles);

  /// Where the circle lies, as PatchLocation::along_m.
  double along_m(std::size_t circle) const { return along_m_[circle]; }

  /// The loads that von_mises_Pa is for from now on; one factor per channel.
  void load(const Eigen::ArrayXd& factors);
  double von_mises_Pa(const PatchLocation& at) const;

  std::array<double, 3> position_m(const PatchLocation& at) const;
  /// For every channel: 6 components as UnitResponses::stress_Pa.
  std::vector<double> unit_stress_Pa(const PatchLocation& at) const;
  /// For every channel: 3 components as UnitResponses::displacement_m.
  std::vector<double> unit_displacement_m(const PatchLocation& at) const;

private:
  std::size_t node(std::size_t circle, int half_plane) const;
  std::array<double, 3> weights_along(double along_m) const;
  /// Weights of the nodes of a circle.
  std::vector<double> weights_around(double angle_rad) const;
  /// The nodes' unit values at a place, each turned with its half plane to the place's own.
  /// @param unit    n values of a node for every channel
  /// @param turned  these in axes that are turned by an angle [rad] about z
  template <std::size_t n, typename Unit>
  std::vector<double> interpolated(const PatchLocation& at, const Unit& unit,
                                   std::array<double, n> (*turned)(double angle_rad, const double*)) const;

  const fem::UnitResponses& responses_;
  int n_angles_;
  std::array<std::size_t, 3> circles_;
  std::array<std::array<double, 2>, 3> zr_m_;
  std::array<double, 3> along_m_;
  std::array<std::vector<std::array<double, 6>>, 3> stress_Pa_;  // about the axis, under the present loads
};

}  // namespace pipelines
