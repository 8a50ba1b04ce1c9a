#include "pipelines/judge/figures/stress_gradient.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fem/base/values/vtk_order.h"

namespace pipelines {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

/// Position of a node in its cells: one that was moved along the surface would make slivers of those around
/// it.
Vector3d position_of_node(const fem::Nodes& nodes, std::size_t node) {
  if (!nodes.moved_from_m.empty())
    if (const auto moved = nodes.moved_from_m.find(node); moved != nodes.moved_from_m.end())
      return Eigen::Map<const Vector3d>(moved->second.data());
  return Vector3d(nodes.xyz_m[3 * node], nodes.xyz_m[3 * node + 1], nodes.xyz_m[3 * node + 2]);
}

/// Outward, of the corner triangle at the face's corner that is nearest to the node: there the face is
/// tangential to the surface up to its size.
Vector3d normal_near(const fem::Nodes& nodes, const fem::NodeList& face, std::size_t node) {
  const std::size_t n_corners = nodes.shape().is_tetrahedron() ? 3 : 4;
  const Vector3d at = position_of_node(nodes, node);
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t c = 0; c < n_corners; ++c)
    if (const double d = (position_of_node(nodes, std::size_t(face[c])) - at).squaredNorm(); d < least) {
      least = d;
      nearest = c;
    }
  // The neighbours along the edges: of a curved face the nodes in the middle of both edges.
  const auto beside = [&](std::size_t corner, std::size_t edge) {
    const bool has_middle = nodes.degree == 2;
    return position_of_node(nodes, std::size_t(has_middle ? face[n_corners + edge] : face[corner]));
  };
  const Vector3d corner = position_of_node(nodes, std::size_t(face[nearest]));
  const std::size_t next = (nearest + 1) % n_corners, before = (nearest + n_corners - 1) % n_corners;
  return (beside(next, nearest) - corner).cross(beside(before, before) - corner).normalized();
}

/// Derivatives of the Lagrange polynomials through the nodes of one direction of a cell: row of the node
/// where it is taken, column of the polynomial. The nodes of degree 3 are Gauss-Lobatto points.
Eigen::MatrixXd derivatives(int degree) {
  const double inner = 0.5 - 0.5 / std::sqrt(5.0);
  const std::vector<double> x = degree == 1   ? std::vector<double>{0, 1}
                                : degree == 2 ? std::vector<double>{0, 0.5, 1}
                                              : std::vector<double>{0, inner, 1 - inner, 1};
  const auto n = Index(x.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (Index at = 0; at < n; ++at)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        if (k == j) continue;
        double product = 1 / (x[std::size_t(j)] - x[std::size_t(k)]);
        for (Index l = 0; l < n; ++l)
          if (l != j && l != k)
            product *= (x[std::size_t(at)] - x[std::size_t(l)]) / (x[std::size_t(j)] - x[std::size_t(l)]);
        result(at, j) += product;
      }
  return result;
}

/// df/dn of a field that the hexahedron interpolates, at one of its nodes, as weights of its nodes; none
/// where the cell has no volume at the node.
std::vector<std::pair<std::size_t, double>> slope_in_cell(const fem::Nodes& nodes, const fem::NodeList& cell,
                                                          std::size_t node, const Vector3d& direction) {
  const int n = nodes.degree + 1;
  const auto table = derivatives(nodes.degree);
  const int* lexicographic = fem::vtk_hexahedron_order(nodes.degree);
  std::vector<std::size_t> at_place(cell.size());
  int place = -1;
  for (std::size_t v = 0; v < cell.size(); ++v) {
    at_place[std::size_t(lexicographic[v])] = std::size_t(cell[v]);
    if (std::size_t(cell[v]) == node) place = lexicographic[v];
  }
  const std::array<int, 3> ijk = {place % n, place / n % n, place / (n * n)}, step = {1, n, n * n};
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  // column: dx by one direction of the cell
  for (int d = 0; d < 3; ++d)
    for (int j = 0; j < n; ++j)
      jacobian.col(d) +=
          table(ijk[d], j) * position_of_node(nodes, at_place[std::size_t(place + (j - ijk[d]) * step[d])]);
  const double lengths = jacobian.col(0).norm() * jacobian.col(1).norm() * jacobian.col(2).norm();
  if (!(std::abs(jacobian.determinant()) > 1e-6 * lengths)) return {};
  const Vector3d along = jacobian.inverse() * direction;
  std::vector<std::pair<std::size_t, double>> weights;
  for (int d = 0; d < 3; ++d)
    for (int j = 0; j < n; ++j)
      weights.emplace_back(at_place[std::size_t(place + (j - ijk[d]) * step[d])],
                           along[d] * table(ijk[d], j));
  return weights;
}

}  // namespace

SurfaceSlopes::SurfaceSlopes(const fem::Nodes& nodes)
    : nodes_(&nodes), cells_of_(nodes.n), faces_of_(nodes.n) {
  std::vector<char> on_surface(nodes.n, 0);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (const auto node : nodes.face(f)) {
      on_surface[std::size_t(node)] = 1;
      faces_of_[std::size_t(node)].push_back(std::int32_t(f));
    }
  // Straight cells need the nodes of the second row, too.
  if (nodes.degree == 1) {
    const auto first_row = on_surface;
    for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
      const auto cell = nodes.cell(c);
      if (std::any_of(cell.begin(), cell.end(), [&](auto node) { return first_row[std::size_t(node)] != 0; }))
        for (const auto node : cell) on_surface[std::size_t(node)] = 1;
    }
  }
  for (std::size_t c = 0; c < nodes.n_cells(); ++c)
    for (const auto node : nodes.cell(c))
      if (on_surface[std::size_t(node)]) {
        auto& cells = cells_of_[std::size_t(node)];
        if (cells.empty() || cells.back() != std::int32_t(c)) cells.push_back(std::int32_t(c));
      }
}

std::array<double, 3> SurfaceSlopes::outward_normal(std::size_t node) const {
  Vector3d outward = Vector3d::Zero();
  for (const auto face : faces_of_[node])
    outward += normal_near(*nodes_, nodes_->face(std::size_t(face)), node);
  if (outward.norm() > 0) outward.normalize();
  return {outward[0], outward[1], outward[2]};
}

SurfaceSlopes::Weights SurfaceSlopes::weights_by_cells(std::size_t node, const Vector3d& direction) const {
  Weights sum;
  int n = 0;
  for (const auto cell : cells_of_[node]) {
    const auto weights = slope_in_cell(*nodes_, nodes_->cell(std::size_t(cell)), node, direction);
    for (const auto& [other, weight] : weights) sum[other] += weight;
    if (!weights.empty()) ++n;
  }
  for (auto& entry : sum) entry.second /= n;
  return sum;
}

std::pair<std::size_t, double> SurfaceSlopes::next_inwards(std::size_t node, std::size_t before,
                                                           const Vector3d& inward) const {
  const auto is_beside = [&](std::size_t other, std::size_t centre) {
    for (const auto c : cells_of_[centre]) {
      const auto cell = nodes_->cell(std::size_t(c));
      if (std::find(cell.begin(), cell.end(), std::int32_t(other)) != cell.end()) return true;
    }
    return false;
  };
  const Vector3d at = position_of_node(*nodes_, node);
  std::pair<std::size_t, double> next{node, 0};
  double most = std::sqrt(0.5);  // within 45 degrees
  for (const auto c : cells_of_[node])
    for (const auto other : nodes_->cell(std::size_t(c))) {
      const Vector3d d = position_of_node(*nodes_, std::size_t(other)) - at;
      if (!(d.dot(inward) > most * d.norm()) || (before != node && is_beside(std::size_t(other), before)))
        continue;
      most = d.dot(inward) / d.norm();
      next = {std::size_t(other), d.norm()};
    }
  return next;
}

std::vector<std::pair<std::size_t, double>> SurfaceSlopes::weights_of_hexahedra(
    std::size_t node, const Vector3d& inward) const {
  Weights slope = weights_by_cells(node, inward);
  if (nodes_->degree == 1) {
    // Straight cells have the slope of their middle. It goes on outwards as it changes to the next row.
    const auto [first, h_1] = next_inwards(node, node, inward);
    const auto [second, h_2] = first == node ? std::pair{node, 0.0} : next_inwards(first, node, inward);
    if (h_2 > 0) {
      const auto below = weights_by_cells(first, inward);
      const double share = below.empty() ? 0 : 2 * h_1 / (h_1 + h_2);
      for (auto& entry : slope) entry.second *= 1 + share;
      for (const auto& [other, weight] : below) slope[other] -= share * weight;
    }
  }
  slope.erase(node);
  return {slope.begin(), slope.end()};
}

std::size_t SurfaceSlopes::stand_in(std::size_t node) const {
  const auto circle = [&](std::size_t of) -> std::array<double, 2> {
    const Vector3d p = position_of_node(*nodes_, of);
    return {std::hypot(p[0], p[1]), p[2]};
  };
  const auto own = circle(node);
  constexpr double rounding = 1e-9;  // share of the radius
  for (const auto face : faces_of_[node])
    for (const auto other : nodes_->face(std::size_t(face))) {
      const auto of = circle(std::size_t(other));
      const bool is_beside = std::abs(of[0] - own[0]) + std::abs(of[1] - own[1]) <= rounding * own[0];
      if (std::size_t(other) != node && is_beside && nodes_->moved_from_m.count(std::size_t(other)) == 0)
        return std::size_t(other);
    }
  return node;
}

std::vector<std::pair<std::size_t, double>> SurfaceSlopes::inward_weights(std::size_t node) const {
  if (nodes_->moved_from_m.count(node) > 0)
    if (const auto beside = stand_in(node); beside != node) {
      auto weights = inward_weights(beside);
      double sum = 0;
      for (const auto& entry : weights) sum += entry.second;
      weights.emplace_back(beside, -sum);
      return weights;
    }
  if (cells_of_[node].empty() || faces_of_[node].empty()) return {};
  const auto outward = outward_normal(node);
  const Vector3d inward = -Eigen::Map<const Vector3d>(outward.data());
  return nodes_->shape().is_tetrahedron() ? weights_of_tetrahedra(node, inward)
                                          : weights_of_hexahedra(node, inward);
}

std::vector<std::pair<std::size_t, double>> SurfaceSlopes::weights_of_tetrahedra(
    std::size_t node, const Vector3d& inward) const {
  std::set<std::int32_t> around;
  for (const auto cell : cells_of_[node])
    for (const auto other : nodes_->cell(std::size_t(cell)))
      if (std::size_t(other) != node) around.insert(other);
  const Vector3d at = position_of_node(*nodes_, node);
  double size = 0;
  for (const auto other : around)
    size = std::max(size, (position_of_node(*nodes_, std::size_t(other)) - at).norm());
  // f(x) - f(here) = g . d + quadratic, d in sizes of the cells; near nodes count most.
  const bool quadratic = around.size() >= 12;
  const Index n_terms = quadratic ? 9 : 3;
  Eigen::MatrixXd terms(Index(around.size()), n_terms);
  Eigen::VectorXd nearness(Index(around.size()));
  Index row = 0;
  for (const auto other : around) {
    const Vector3d d = (position_of_node(*nodes_, std::size_t(other)) - at) / size;
    terms.row(row).head<3>() = d;
    if (quadratic)
      terms.row(row).tail<6>() << d[0] * d[0], d[1] * d[1], d[2] * d[2], d[0] * d[1], d[1] * d[2],
          d[2] * d[0];
    nearness[row] = 1 / (0.1 + d.norm());
    terms.row(row) *= nearness[row];
    ++row;
  }
  // The fit's slope is linear in the values: the transposed problem has its weights.
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(n_terms);
  slope.head<3>() = inward / size;
  const Eigen::VectorXd fit = terms.colPivHouseholderQr().transpose().solve(slope);
  std::vector<std::pair<std::size_t, double>> weights;
  row = 0;
  for (const auto other : around) {
    weights.emplace_back(std::size_t(other), fit[row] * nearness[row]);
    ++row;
  }
  return weights;
}

double SurfaceSlopes::related_gradient_per_m(std::size_t node,
                                             const std::function<double(std::size_t)>& field) const {
  const double here = field(node);
  if (!(here > 0)) return 0;
  double slope = 0;
  for (const auto& [other, weight] : inward_weights(node)) slope += weight * (field(other) - here);
  return std::max(0.0, -slope / here);
}

}  // namespace pipelines
