#include "fem/operators/elastic_operator.h"

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "fem/common/parallel.h"
#include "fem/mesh/cell_geometry.h"
#include "fem/mesh/hanging_nodes.h"

namespace fem {

namespace {

/// [point][i] of polynomials through the places `through`, at the points `at`.
template <typename T>
std::vector<T> tabulate(const std::vector<dealii::Point<1>>& through, const std::vector<dealii::Point<1>>& at,
                        int derivative) {
  std::vector<T> table;
  const auto shapes = dealii::Polynomials::generate_complete_Lagrange_basis(through);
  for (const auto& point : at)
    for (const auto& shape : shapes) {
      std::vector<double> values(2);
      shape.value(point[0], values);
      table.push_back(static_cast<T>(values[derivative]));
    }
  return table;
}

}  // namespace

std::vector<double> cell_metric(const Grid& grid, const CellOrder& order) {
  const Tabulation at = gauss_in_cell(grid.shape(), grid.degree + 1);
  std::vector<double> metric(grid.n_cells() * at.n_points * 9);
  parallel_for(grid.n_cells(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (int q = 0; q < at.n_points; ++q) {
        const Eigen::Matrix3d j = jacobian(grid, order.cell[k], at, q);
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> m(metric.data() + (k * at.n_points + q) * 9);
        m = std::sqrt(j.determinant() * at.weight[q]) * j.inverse();
      }
  });
  return metric;
}

std::vector<double> diagonal_blocks(const Grid& grid, const CellOrder& order,
                                    const std::vector<double>& metric, const PerCell<Lame>& elastic) {
  const Tabulation at = gauss_in_cell(grid.shape(), grid.degree + 1);
  const int n_local = grid.nodes_per_cell();
  std::vector<double> products(grid.n_cells() * n_local * 6);  // of a node's gradient with itself
  parallel_for(grid.n_cells(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (int i = 0; i < n_local; ++i) {
        double h[6] = {0, 0, 0, 0, 0, 0};
        for (int q = 0; q < at.n_points; ++q) {
          const double* m = &metric[(k * at.n_points + q) * 9];
          const auto& g = at.gradient[std::size_t(q) * at.n_shapes + i];
          const double x = m[0] * g[0] + m[3] * g[1] + m[6] * g[2];
          const double y = m[1] * g[0] + m[4] * g[1] + m[7] * g[2];
          const double z = m[2] * g[0] + m[5] * g[1] + m[8] * g[2];
          h[0] += x * x, h[1] += y * y, h[2] += z * z, h[3] += x * y, h[4] += y * z, h[5] += x * z;
        }
        std::copy(h, h + 6, &products[(k * n_local + i) * 6]);
      }
  });
  std::vector<double> blocks(9 * grid.n_nodes, 0.0);
  const auto add = [&](std::int32_t cell, std::int32_t node, const double* h) {
    double* block = &blocks[9 * std::size_t(order.node_place[node])];
    const Lame& own = elastic[cell];
    const double both = own.lambda_Pa + own.mu_Pa;
    const double trace = own.mu_Pa * (h[0] + h[1] + h[2]);
    const double full[9] = {h[0], h[3], h[5], h[3], h[1], h[4], h[5], h[4], h[2]};
    for (int e = 0; e < 9; ++e) block[e] += both * full[e] + (e % 4 == 0 ? trace : 0.0);
  };
  const CellCouplings couplings(grid);
  for (std::size_t k = 0; k < grid.n_cells(); ++k) {
    const auto cell = order.cell[k];
    if (couplings.is_plain(std::size_t(cell))) {
      for (int i = 0; i < n_local; ++i) add(cell, grid.nodes_of(cell)[i], &products[(k * n_local + i) * 6]);
      continue;
    }
    // Gradients of the masters' shape functions, of which those of hanging nodes are part.
    Eigen::MatrixXd gradient(3 * n_local, at.n_points);
    for (int q = 0; q < at.n_points; ++q) {
      const Eigen::Map<const Eigen::Matrix3d> to_space(
          &metric[(k * at.n_points + q) * 9]);  // transposed here
      for (int i = 0; i < n_local; ++i)
        gradient.block<3, 1>(3 * i, q) = to_space * Eigen::Map<const Eigen::Vector3d>(
                                                        at.gradient[std::size_t(q) * at.n_shapes + i].data());
    }
    couplings.couple(std::size_t(cell), 3, gradient);
    for (int i = 0; i < couplings.n_nodes(std::size_t(cell)); ++i) {
      const Eigen::Matrix3d own = gradient.middleRows<3>(3 * i) * gradient.middleRows<3>(3 * i).transpose();
      const double h[6] = {own(0, 0), own(1, 1), own(2, 2), own(0, 1), own(1, 2), own(0, 2)};
      add(cell, couplings.nodes(std::size_t(cell))[i], h);
    }
  }
  return blocks;
}

template <typename T>
ElasticOperator<T>::ElasticOperator(const Grid& grid, const CellOrder& order, const PerCell<Lame>& elastic,
                                    std::vector<double> metric, const kernel::Kernels& kernels,
                                    std::shared_ptr<const AddTargets> targets, const SharedNodes* shared)
    : kernels_(&kernels),
      n_nodes_(grid.n_nodes),
      part_begin_(order.part_begin),
      has_own_targets_(targets == nullptr),
      targets_(targets ? std::move(targets) : std::make_shared<const AddTargets>(make_targets(grid, order))),
      hanging_(grid.hanging, order.node_place),
      shared_(shared) {
  if constexpr (std::is_same_v<T, double>)
    metric_ = std::move(metric);
  else
    metric_.assign(metric.begin(), metric.end());
  elastic_.reserve(2 * grid.n_cells());
  for (const auto cell : order.cell) {
    elastic_.push_back(static_cast<T>(elastic[cell].lambda_Pa));
    elastic_.push_back(static_cast<T>(elastic[cell].mu_Pa));
  }
  std::vector<dealii::Point<1>> nodes;
  for (int i = 0; i <= grid.degree; ++i)
    nodes.emplace_back(dealii::QGaussLobatto<1>(grid.degree + 1).point(i));
  const auto points = dealii::QGauss<1>(grid.degree + 1).get_points();
  value_ = tabulate<T>(nodes, points, 0);
  derivative_ = tabulate<T>(points, points, 1);
  cells_.n = grid.degree + 1;
  cells_.n_nodes = n_nodes_;
  cells_.n_copies = targets_->copy.size();
}

template <typename T>
std::size_t ElasticOperator<T>::bytes() const noexcept {
  const std::size_t n_targets = has_own_targets_ ? targets_->node.size() + targets_->target.size() : 0;
  return (metric_.size() + elastic_.size()) * sizeof(T) + n_targets * sizeof(std::int32_t);
}

template <typename T>
void ElasticOperator<T>::apply(const Lanes& lanes, BlockVector<T>& x, BlockVector<T>& y,
                               BlockVector<T>& copies) const {
  if (!hanging_.is_empty()) hanging_.set(lanes, x);
  parallel_for(part_begin_.size() - 1, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last; ++part) {
      auto cells = cells_;
      cells.value = value_.data();
      cells.derivative = derivative_.data();
      cells.metric = metric_.data();
      cells.elastic_Pa = elastic_.data();
      cells.node = targets_->node.data();
      cells.target = targets_->target.data();
      cells.begin = part_begin_[part];
      cells.end = part_begin_[part + 1];
      if constexpr (std::is_same_v<T, double>)
        kernels_->apply_double(cells, lanes.view(), x.data(), y.data(), copies.data());
      else
        kernels_->apply_float(cells, lanes.view(), x.data(), y.data(), copies.data());
    }
  });
  for (const auto& group : lanes.groups) {
    T* to = y.data() + 3 * n_nodes_ * group.first_lane;
    const T* from = copies.data() + 3 * targets_->copy.size() * group.first_lane;
    const std::size_t per_node = 3 * std::size_t(group.width);
    for (std::size_t k = 0; k < targets_->copy.size(); ++k)
      for (std::size_t l = 0; l < per_node; ++l)
        to[targets_->copied[k] * per_node + l] += from[targets_->copy[k] * per_node + l];
  }
  if (!hanging_.is_empty()) hanging_.move_to_masters(lanes, y);
  if (shared_ != nullptr) shared_->sum(lanes, y);
}

template class ElasticOperator<double>;
template class ElasticOperator<float>;

}  // namespace fem
