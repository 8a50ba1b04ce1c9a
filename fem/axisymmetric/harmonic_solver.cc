#include "fem/axisymmetric/harmonic_solver.h"

#include <algorithm>

#include "fem/axisymmetric/harmonic_strain.h"
#include "fem/common/dense_algebra.h"

namespace fem {
namespace {

NodeGraph graph_of(const MeridianGrid& grid) {
  std::vector<std::vector<std::int32_t>> larger(std::size_t(grid.n_nodes()));
  for (const auto& nodes : grid.cell_nodes)
    for (const int i : nodes)
      for (const int j : nodes)
        if (j > i) larger[std::size_t(i)].push_back(j);
  NodeGraph graph;
  graph.begin.push_back(0);
  for (auto& list : larger) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    graph.neighbour.insert(graph.neighbour.end(), list.begin(), list.end());
    graph.begin.push_back(std::int64_t(graph.neighbour.size()));
  }
  return graph;
}

}  // namespace

HarmonicPattern::HarmonicPattern(const MeridianGrid& grid)
    : graph(graph_of(grid)), order(order_nodes(graph)) {}

HarmonicSolver::HarmonicSolver(const MeridianGrid& grid, const HarmonicPattern& pattern,
                               const Material& material)
    : grid_(&grid),
      material_(material),
      pattern_(&pattern),
      matrix_(make_matrix(pattern.graph)),
      factor_(pattern.graph, pattern.order) {}

std::vector<char> HarmonicSolver::held_unknowns(int m) const {
  const auto& z = grid_->z_m;
  std::vector<char> held(3 * z.size(), 0);
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (!grid_->on_axis[i]) continue;
    held[3 * i] = m != 1;
    held[3 * i + 1] = 1;  // at m = 1 the sum U + V, see assemble
    held[3 * i + 2] = m != 0;
  }
  const auto low = std::size_t(std::min_element(z.begin(), z.end()) - z.begin());
  const auto high = std::size_t(std::max_element(z.begin(), z.end()) - z.begin());
  if (m == 0) {
    held[3 * low + 2] = 1;
    const auto& r = grid_->r_m;
    held[3 * std::size_t(std::max_element(r.begin(), r.end()) - r.begin()) + 1] = 1;
  } else if (m == 1) {
    held[3 * low] = held[3 * high] = 1;
  }
  return held;
}

void HarmonicSolver::assemble(int m, const std::vector<char>& held) {
  std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
  const NodeGraph& graph = pattern_->graph;
  const auto elasticity = elasticity_matrix(material_);
  for (std::size_t c = 0; c < grid_->cell_nodes.size(); ++c) {
    const auto& nodes = grid_->cell_nodes[c];
    const auto& points = grid_->cell_points[c];
    const auto n = Eigen::Index(3 * nodes.size());
    Eigen::MatrixXd strain(6 * points.size(), n), stress(6 * points.size(), n);
    for (std::size_t q = 0; q < points.size(); ++q) {
      auto b = strain.middleRows<6>(6 * Eigen::Index(q));
      b = strain_matrix(points[q], m);
      if (m == 1)  // on the axis the unknowns are U = -V and, held, U + V
        for (std::size_t i = 0; i < nodes.size(); ++i)
          if (grid_->on_axis[std::size_t(nodes[i])])
            b.col(3 * Eigen::Index(i)) -= b.col(3 * Eigen::Index(i) + 1);
      stress.middleRows<6>(6 * Eigen::Index(q)).noalias() =
          angle_integral(m) * points[q].r_m * points[q].weight * elasticity * b;
    }
    const Eigen::MatrixXd stiffness = transposed_product(strain, stress);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        const std::int64_t row = nodes[a], column = nodes[b];
        if (row < column) continue;
        std::int64_t offset = 0;
        if (row > column) {
          const auto first = graph.neighbour.begin() + graph.begin[std::size_t(column)];
          const auto last = graph.neighbour.begin() + graph.begin[std::size_t(column) + 1];
          offset = 3 * (std::lower_bound(first, last, row) - first) + 3;
        }
        for (int d = 0; d < 3; ++d)
          for (int e = row == column ? d : 0; e < 3; ++e)
            if (!held[std::size_t(3 * row + e)] && !held[std::size_t(3 * column + d)])
              matrix_
                  .value[std::size_t(matrix_.column_begin[std::size_t(3 * column + d)] + offset + e - d)] +=
                  stiffness(3 * Eigen::Index(a) + e, 3 * Eigen::Index(b) + d);
      }
  }
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) matrix_.value[std::size_t(matrix_.column_begin[i])] = material_.youngs_modulus_Pa;
}

Eigen::MatrixXd HarmonicSolver::solve(int m, const Eigen::MatrixXd& force, double& residual) {
  const auto held = held_unknowns(m);
  assemble(m, held);
  Eigen::MatrixXd f = force;
  if (m == 1)
    for (int i = 0; i < grid_->n_nodes(); ++i)
      if (grid_->on_axis[std::size_t(i)]) f.row(3 * i) -= f.row(3 * i + 1);
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) f.row(Eigen::Index(i)).setZero();
  factor_.factorise(matrix_);
  Eigen::MatrixXd u = factor_.solve(f);
  const Eigen::MatrixXd rest = multiply(matrix_, u) - f;
  for (Eigen::Index k = 0; k < f.cols(); ++k)
    if (const double size = f.col(k).norm(); size > 0)
      residual = std::max(residual, rest.col(k).norm() / size);
  if (m == 1)
    for (int i = 0; i < grid_->n_nodes(); ++i)
      if (grid_->on_axis[std::size_t(i)]) u.row(3 * i + 1) = -u.row(3 * i);
  return u;
}

}  // namespace fem
