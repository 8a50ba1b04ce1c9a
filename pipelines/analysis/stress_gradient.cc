#include "pipelines/analysis/stress_gradient.h"

#include <Eigen/Dense>
#include <algorithm>
#include <set>

namespace pipelines {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

Vector3d position_of_node(const fem::Nodes& nodes, std::size_t node) {
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

}  // namespace

SurfaceSlopes::SurfaceSlopes(const fem::Nodes& nodes)
    : nodes_(&nodes), cells_of_(nodes.n), faces_of_(nodes.n) {
  std::vector<char> on_surface(nodes.n, 0);
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (const auto node : nodes.face(f)) {
      on_surface[std::size_t(node)] = 1;
      faces_of_[std::size_t(node)].push_back(std::int32_t(f));
    }
  for (std::size_t c = 0; c < nodes.n_cells(); ++c)
    for (const auto node : nodes.cell(c))
      if (on_surface[std::size_t(node)]) cells_of_[std::size_t(node)].push_back(std::int32_t(c));
}

std::array<double, 3> SurfaceSlopes::outward_normal(std::size_t node) const {
  Vector3d outward = Vector3d::Zero();
  for (const auto face : faces_of_[node])
    outward += normal_near(*nodes_, nodes_->face(std::size_t(face)), node);
  if (outward.norm() > 0) outward.normalize();
  return {outward[0], outward[1], outward[2]};
}

std::vector<std::pair<std::size_t, double>> SurfaceSlopes::inward_weights(std::size_t node) const {
  if (cells_of_[node].empty() || faces_of_[node].empty()) return {};
  const auto outward = outward_normal(node);
  const Vector3d inward = -Eigen::Map<const Vector3d>(outward.data());

  std::set<std::int32_t> around;
  for (const auto cell : cells_of_[node])
    for (const auto other : nodes_->cell(std::size_t(cell)))
      if (std::size_t(other) != node) around.insert(other);
  const Vector3d at = position_of_node(*nodes_, node);
  double size = 0;
  for (const auto other : around)
    size = std::max(size, (position_of_node(*nodes_, std::size_t(other)) - at).norm());
  // f(x) - f(here) = g . d + quadratic, d in sizes of the cells; near nodes count most.
  const bool quadratic = nodes_->degree >= 2 && around.size() >= 12;
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
