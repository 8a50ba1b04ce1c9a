#include "fem/models/axisymmetric/harmonic_solver.h"

#include <algorithm>

#include "fem/base/common/dense_algebra.h"
#include "fem/equations/loads/clamps.h"
#include "fem/models/axisymmetric/harmonic_strain.h"

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

std::vector<std::int64_t> HarmonicSolver::held_unknowns(int m) const {
  const auto& z = grid_->z_m;
  std::vector<std::int64_t> held;
  const auto hold = [&](std::ptrdiff_t node, int component) { held.push_back(3 * node + component); };
  for (int i = 0; i < grid_->n_nodes(); ++i) {
    if (!grid_->on_axis[std::size_t(i)]) continue;
    if (m != 1) hold(i, 0);
    hold(i, 1);  // at m = 1 the sum U + V, see assemble
    if (m != 0) hold(i, 2);
  }
  const auto low = std::min_element(z.begin(), z.end()) - z.begin();
  const auto high = std::max_element(z.begin(), z.end()) - z.begin();
  if (m == 0) {
    const auto& r = grid_->r_m;
    hold(low, 2);
    hold(std::max_element(r.begin(), r.end()) - r.begin(), 1);
  } else if (m == 1) {
    hold(low, 0);
    hold(high, 0);
  }
  return held;
}

void HarmonicSolver::assemble(int m, const std::vector<std::int64_t>& held) {
  matrix_.value.setZero();
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
      for (std::size_t b = 0; b < nodes.size(); ++b)
        if (nodes[a] >= nodes[b])
          add_block(pattern_->graph, nodes[a], nodes[b],
                    stiffness.block<3, 3>(3 * Eigen::Index(a), 3 * Eigen::Index(b)), matrix_);
  }
  clamp(held, matrix_);
  for (const auto i : held)
    matrix_.value[std::size_t(matrix_.column_begin[std::size_t(i)])] = material_.youngs_modulus_Pa;
}

Eigen::MatrixXd HarmonicSolver::solve(int m, const Eigen::MatrixXd& force, double& residual) {
  const auto held = held_unknowns(m);
  assemble(m, held);
  Eigen::MatrixXd f = force;
  if (m == 1)
    for (int i = 0; i < grid_->n_nodes(); ++i)
      if (grid_->on_axis[std::size_t(i)]) f.row(3 * i) -= f.row(3 * i + 1);
  clear_rows(held, f);
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
