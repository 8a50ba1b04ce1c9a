#include "fem/stress/tetrahedra_error.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/common/simplex.h"
#include "fem/operators/stiffness.h"

namespace fem {
namespace {

using Tensor = std::array<double, 6>;  // xx, yy, zz, xy, yz, xz

constexpr std::array<std::array<std::size_t, 2>, 6> ends_of_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Four points, exact for squares of linear fields: Hammer, Marlowe and Stroud (1956), a = (5 - sqrt 5) / 20.
constexpr double near_corner = 0.58541019662496845, far_from_it = 0.13819660112501051;
constexpr std::array<std::array<double, 3>, 4> points = {{{far_from_it, far_from_it, far_from_it},
                                                          {near_corner, far_from_it, far_from_it},
                                                          {far_from_it, near_corner, far_from_it},
                                                          {far_from_it, far_from_it, near_corner}}};

double von_mises(const Tensor& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// The node itself if it is a corner, else the ends of its edge.
std::vector<std::int32_t> corners_of(const Nodes& nodes, std::size_t node) {
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    const auto local = std::size_t(std::find(cell.begin(), cell.end(), std::int32_t(node)) - cell.begin());
    if (local < 4) return {std::int32_t(node)};
    if (local < cell.size()) return {cell[ends_of_edges[local - 4][0]], cell[ends_of_edges[local - 4][1]]};
  }
  throw std::invalid_argument("cells_against_recovered: no cell holds node " + std::to_string(node));
}

/// One load case: the sum of all channels times their factors.
class LoadCase {
public:
  LoadCase(const UnitResponses& responses, const Material& material, const std::vector<double>& factors)
      : responses_(responses), elastic_(lame(material)), factors_(factors) {}

  Tensor recovered(std::int32_t node) const {
    Tensor stress{};
    for (std::size_t k = 0; k < factors_.size(); ++k)
      for (std::size_t c = 0; c < 6; ++c)
        stress[c] += factors_[k] * responses_.stress_Pa[(std::size_t(node) * factors_.size() + k) * 6 + c];
    return stress;
  }

  /// Recovered minus own stress at a point of a cell, and the determinant of its mapping.
  std::pair<Tensor, double> difference(const NodeList& cell, const std::array<double, 3>& point) const {
    const auto shapes = quadratic_tetrahedron(point);
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero(), along = Eigen::Matrix3d::Zero();
    Tensor stress{};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Eigen::Map<const Eigen::RowVector3d> slope(shapes[i].gradient.data());
      jacobian +=
          Eigen::Map<const Eigen::Vector3d>(&responses_.nodes.xyz_m[3 * std::size_t(cell[i])]) * slope;
      along += displacement(cell[i]) * slope;
      const Tensor nodal = recovered(cell[i]);
      for (std::size_t c = 0; c < 6; ++c) stress[c] += shapes[i].value * nodal[c];
    }
    const Eigen::Matrix3d g = along * jacobian.inverse();
    const double dilatation = elastic_.lambda_Pa * g.trace(), mu = elastic_.mu_Pa;
    for (int d = 0; d < 3; ++d) stress[std::size_t(d)] -= dilatation + 2 * mu * g(d, d);
    stress[3] -= mu * (g(0, 1) + g(1, 0));
    stress[4] -= mu * (g(1, 2) + g(2, 1));
    stress[5] -= mu * (g(0, 2) + g(2, 0));
    return {stress, jacobian.determinant()};
  }

private:
  Eigen::Vector3d displacement(std::int32_t node) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t first = std::size_t(node) * factors_.size();
    for (std::size_t k = 0; k < factors_.size(); ++k)
      sum += factors_[k] * Eigen::Map<const Eigen::Vector3d>(&responses_.displacement_m[(first + k) * 3]);
    return sum;
  }

  const UnitResponses& responses_;
  Lame elastic_;
  const std::vector<double>& factors_;
};

}  // namespace

CellsAgainstRecovered cells_against_recovered(const UnitResponses& responses, const Material& material,
                                              std::size_t node, const std::vector<double>& factors) {
  const auto& nodes = responses.nodes;
  if (!nodes.shape().is_tetrahedron())
    throw std::invalid_argument("cells_against_recovered: the cells are no tetrahedra");
  if (factors.size() != responses.channels.size())
    throw std::invalid_argument("cells_against_recovered: one factor for every channel");
  const LoadCase load(responses, material, factors);
  const auto corners = corners_of(nodes, node);
  double squares = 0, volume = 0;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    const bool is_around = std::any_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
      return std::find(cell.begin(), cell.begin() + 4, corner) != cell.begin() + 4;
    });
    if (!is_around) continue;
    for (const auto& point : points) {
      const auto [stress, determinant] = load.difference(cell, point);
      const double size = von_mises(stress);
      squares += determinant * size * size;
      volume += determinant;
    }
  }
  return {von_mises(load.recovered(std::int32_t(node))), std::sqrt(squares / volume)};
}

}  // namespace fem
