#include "fem/equations/loads/elastic_supports.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/base/common/dense_algebra.h"
#include "fem/equations/loads/surface_loads.h"
#include "fem/mesh/grid/hanging_nodes.h"
#include "fem/mesh/grid/rigid_modes.h"

namespace fem {

namespace {

/// Springs' forces that close: the null space of their resultants, moments in units of the body's size.
Eigen::MatrixXd closing_forces(const Grid& grid, const Eigen::MatrixXd& forces) {
  const Eigen::Map<const Eigen::Matrix3Xd> nodes(grid.xyz_m.data(), 3, grid.n_nodes);
  const Eigen::Vector3d centre = nodes.rowwise().mean();
  const double size_m = (nodes.colwise() - centre).colwise().norm().maxCoeff();
  Eigen::MatrixXd sums = resultants(grid, forces, centre);
  sums.bottomRows<3>() /= size_m;
  constexpr double negligible = 1e-9;  // of the largest singular value: feet in one line to that precision
  const RowSpace space = row_space(sums, negligible);
  return space.vector.rightCols(forces.cols() - space.rank);
}

}  // namespace

ElasticSupports::ElasticSupports(const Grid& grid, const std::vector<ElasticSupport>& supports) {
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> stiffness;
  for (const auto& support : supports) {
    const Eigen::MatrixXd unit = unit_resultants(grid, support.surface);
    for (int d = 0; d < 3; ++d) {
      const double k = support.stiffness_N_m[d];
      if (!(k >= 0) || !std::isfinite(k))
        throw std::invalid_argument("elastic support: stiffness " + std::to_string(k) +
                                    " N/m must be zero or positive");
      if (k == 0) continue;
      columns.push_back(unit.col(d));
      stiffness.push_back(k);
    }
  }
  forces_.resize(3 * grid.n_nodes, columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) forces_.col(i) = columns[i];
  move_to_masters(grid.hanging, forces_);
  stiffness_N_m_ = Eigen::Map<const Eigen::VectorXd>(stiffness.data(), stiffness.size());
  if (!columns.empty()) closed_ = closing_forces(grid, forces_);
}

Eigen::MatrixXd ElasticSupports::apply(Eigen::MatrixXd displacement) const {
  return apply(std::move(displacement), forces_, [](Eigen::MatrixXd&) {});
}

Eigen::MatrixXd ElasticSupports::apply(Eigen::MatrixXd displacement, const Eigen::MatrixXd& forces,
                                       const std::function<void(Eigen::MatrixXd&)>& complete) const {
  const auto n_springs = forces_.cols(), n_loads = displacement.cols() - n_springs;
  if (n_springs == 0) return displacement;
  Eigen::MatrixXd result = displacement.leftCols(n_loads);
  if (closed_.cols() == 0) return result;
  const auto of_forces = displacement.rightCols(n_springs);
  Eigen::MatrixXd flexibility = transposed_product(forces, of_forces),
                  along = transposed_product(forces, result);
  complete(flexibility);
  complete(along);
  flexibility.diagonal() += stiffness_N_m_.cwiseInverse();
  const Eigen::MatrixXd small = product(transposed_product(closed_, flexibility), closed_);
  const Eigen::MatrixXd wanted = transposed_product(closed_, along);
  subtract_product(of_forces, product(closed_, solve_symmetric(small, wanted)), result);
  return result;
}

}  // namespace fem
