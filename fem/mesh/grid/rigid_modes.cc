#include "fem/mesh/grid/rigid_modes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

/// Integrals over one cell after another, by products of matrices: points of the rule times shape functions.
class CellMoments {
public:
  using Moments = Eigen::Matrix<double, Eigen::Dynamic, 4>;

  explicit CellMoments(const Grid& grid) : grid_(grid), at_(moment_points_in_cell(grid.shape())) {
    value_ = Eigen::Map<const Eigen::MatrixXd>(at_.value.data(), at_.n_shapes, at_.n_points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along_[axis].resize(at_.n_points, at_.n_shapes);
      for (int q = 0; q < at_.n_points; ++q)
        for (int i = 0; i < at_.n_shapes; ++i)
          along_[axis](q, i) = at_.gradient[std::size_t(q) * at_.n_shapes + i][axis];
    }
  }

  /// Integrals of N_i, N_i x, N_i y, N_i z over the cell (n_shapes x 4).
  Moments of(std::size_t cell) const {
    const auto* nodes = grid_.nodes_of(cell);
    Eigen::Matrix<double, Eigen::Dynamic, 3> x(at_.n_shapes, 3);
    for (int i = 0; i < at_.n_shapes; ++i)
      x.row(i) = Eigen::Map<const Eigen::RowVector3d>(grid_.position(nodes[i]));
    std::array<Eigen::Array<double, Eigen::Dynamic, 3>, 3> tangent;
    for (std::size_t axis = 0; axis < 3; ++axis) tangent[axis] = (along_[axis] * x).array();
    const auto& [a, b, c] = tangent;
    Moments moments(at_.n_points, 4);
    moments.col(0) = Eigen::Map<const Eigen::ArrayXd>(at_.weight.data(), at_.n_points) *
                     (a.col(0) * (b.col(1) * c.col(2) - b.col(2) * c.col(1)) +
                      a.col(1) * (b.col(2) * c.col(0) - b.col(0) * c.col(2)) +
                      a.col(2) * (b.col(0) * c.col(1) - b.col(1) * c.col(0)));
    moments.rightCols<3>() = moments.col(0).asDiagonal() * (value_.transpose() * x);
    return value_ * moments;
  }

  void add(std::size_t cell, const Moments& moments, NodeIntegrals& integrals) const {
    const auto* nodes = grid_.nodes_of(cell);
    for (int i = 0; i < at_.n_shapes; ++i) integrals.row(nodes[i]) += moments.row(i);
  }

private:
  const Grid& grid_;
  Tabulation at_;
  Eigen::MatrixXd value_;                 // shape functions x points
  std::array<Eigen::MatrixXd, 3> along_;  // points x derivatives of the shape functions
};

}  // namespace

NodeIntegrals integrate_nodes(const Grid& grid, const std::vector<std::vector<std::int32_t>>& colours) {
  const CellMoments moments(grid);
  NodeIntegrals integrals = NodeIntegrals::Zero(grid.n_nodes, 4);
  for (const auto& cells : colours)
    parallel_for(cells.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) moments.add(cells[c], moments.of(cells[c]), integrals);
    });
  return integrals;
}

NodeIntegrals integrate_nodes(const Grid& grid, const std::vector<int>& volume_ids) {
  for (const int id : volume_ids)
    if (std::find(grid.volume_id.begin(), grid.volume_id.end(), id) == grid.volume_id.end())
      throw std::invalid_argument("the mesh has no cells in the volume group " + std::to_string(id));
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    if (std::find(volume_ids.begin(), volume_ids.end(), grid.volume_id[c]) != volume_ids.end())
      cells.push_back(c);
  const CellMoments moments(grid);
  NodeIntegrals integrals = NodeIntegrals::Zero(grid.n_nodes, 4);
  // Neighbours write to the same nodes: integrated on all threads, added up on one.
  constexpr std::size_t most_at_once = 1024;
  std::vector<CellMoments::Moments> of_cells(std::min(most_at_once, cells.size()));
  for (std::size_t first = 0; first < cells.size(); first += most_at_once) {
    const auto n = std::min(most_at_once, cells.size() - first);
    parallel_for(n, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) of_cells[k] = moments.of(cells[first + k]);
    });
    for (std::size_t k = 0; k < n; ++k) moments.add(cells[first + k], of_cells[k], integrals);
  }
  return integrals;
}

MassProperties mass_properties(const Grid& grid, const NodeIntegrals& integrals, double density_kg_m3) {
  MassProperties body;
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> x(grid.xyz_m.data(),
                                                                                      grid.n_nodes, 3);
  body.volume_m3 = integrals.col(0).sum();
  body.mass_kg = density_kg_m3 * body.volume_m3;
  for (int d = 0; d < 3; ++d) body.first_moment_kg_m[d] = density_kg_m3 * integrals.col(1 + d).sum();
  const Eigen::Matrix3d second = density_kg_m3 * x.transpose().lazyProduct(integrals.rightCols<3>());
  body.second_moments_kg_m2 = {second(0, 0), second(1, 1), second(2, 2),
                               second(0, 1), second(1, 2), second(0, 2)};
  return body;
}

Eigen::MatrixXd rigid_modes(const Grid& grid, const Eigen::Vector3d& centre) {
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(3 * grid.n_nodes, 6);
  for (std::size_t i = 0; i < grid.n_nodes; ++i) {
    const double x = grid.xyz_m[3 * i] - centre[0], y = grid.xyz_m[3 * i + 1] - centre[1],
                 z = grid.xyz_m[3 * i + 2] - centre[2];
    modes.block<3, 3>(3 * i, 0).setIdentity();
    modes.block<3, 3>(3 * i, 3) << 0, z, -y, -z, 0, x, y, -x, 0;
  }
  return modes;
}

Eigen::MatrixXd resultants(const Grid& grid, const Eigen::MatrixXd& force, const Eigen::Vector3d& centre) {
  return transposed_product(rigid_modes(grid, centre), force);
}

RigidBalance::RigidBalance(const Grid& grid, const NodeIntegrals& integrals)
    : grid_(grid),
      integrals_(integrals),
      centre_m_(integrals.rightCols<3>().colwise().sum().transpose() / integrals.col(0).sum()) {
  Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index i = 0; i < integrals.rows(); ++i)
    for (int mode = 0; mode < 6; ++mode) {
      const Eigen::Vector3d moved = mode < 3 ? Eigen::Vector3d(mass(i) * Eigen::Vector3d::Unit(mode))
                                             : Eigen::Vector3d::Unit(mode - 3).cross(moment(i));
      inertia.col(mode).head<3>() += moved;
      inertia.col(mode).tail<3>() += place_m(i).cross(moved);
    }
  inverse_ = inverse(inertia);
}

Eigen::Vector3d RigidBalance::place_m(Eigen::Index node) const {
  return Eigen::Map<const Eigen::Vector3d>(grid_.position(std::size_t(node))) - centre_m_;
}

Eigen::Vector3d RigidBalance::moment(Eigen::Index node) const {
  return integrals_.row(node).tail<3>().transpose() - mass(node) * centre_m_;
}

namespace {

/// Sum over items of a 6-vector, in pieces: rounding grows with the length of a piece.
template <typename Item>
Eigen::Matrix<double, 6, 1> sum_in_pieces(Eigen::Index n, const Item& add) {
  constexpr Eigen::Index piece = 1024;
  Eigen::Matrix<double, 6, 1> total = Eigen::Matrix<double, 6, 1>::Zero();
  for (Eigen::Index first = 0; first < n; first += piece) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (Eigen::Index i = first; i < std::min(n, first + piece); ++i) add(i, sum);
    total += sum;
  }
  return total;
}

}  // namespace

// Column by column: the modes are as simple to apply as to store, and large.
void RigidBalance::balance(Eigen::MatrixXd& force) const {
  parallel_for(force.cols(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      Eigen::Map<Eigen::Matrix3Xd> f(force.col(k).data(), 3, integrals_.rows());
      const auto resultant = sum_in_pieces(f.cols(), [&](Eigen::Index i, auto& sum) {
        sum.template head<3>() += f.col(i);
        sum.template tail<3>() += place_m(i).cross(f.col(i));
      });
      const Eigen::Matrix<double, 6, 1> acceleration = inverse_ * resultant;
      const Eigen::Vector3d along = acceleration.head<3>(), about = acceleration.tail<3>();
      for (Eigen::Index i = 0; i < f.cols(); ++i) f.col(i) -= mass(i) * along + about.cross(moment(i));
    }
  });
}

void RigidBalance::remove_motion(Eigen::MatrixXd& displacement) const {
  parallel_for(displacement.cols(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      Eigen::Map<Eigen::Matrix3Xd> u(displacement.col(k).data(), 3, integrals_.rows());
      const auto momentum = sum_in_pieces(u.cols(), [&](Eigen::Index i, auto& sum) {
        sum.template head<3>() += mass(i) * u.col(i);
        sum.template tail<3>() += moment(i).cross(u.col(i));
      });
      const Eigen::Matrix<double, 6, 1> motion = inverse_ * momentum;
      const Eigen::Vector3d along = motion.head<3>(), about = motion.tail<3>();
      for (Eigen::Index i = 0; i < u.cols(); ++i) u.col(i) -= along + about.cross(place_m(i));
    }
  });
}

void RigidBalance::remove_motion(const std::vector<std::int32_t>& node, const std::vector<char>& counted,
                                 const std::function<void(Eigen::MatrixXd&)>& complete,
                                 Eigen::MatrixXd& displacement) const {
  const auto n = Eigen::Index(node.size());
  Eigen::MatrixXd momentum(6, displacement.cols());
  parallel_for(displacement.cols(), 1, [&](std::size_t first, std::size_t last) {
    for (auto k = Eigen::Index(first); k < Eigen::Index(last); ++k) {
      const Eigen::Map<const Eigen::Matrix3Xd> u(displacement.col(k).data(), 3, n);
      momentum.col(k) = sum_in_pieces(n, [&](Eigen::Index i, auto& sum) {
        if (counted[std::size_t(i)] == 0) return;
        sum.template head<3>() += mass(node[std::size_t(i)]) * u.col(i);
        sum.template tail<3>() += moment(node[std::size_t(i)]).cross(u.col(i));
      });
    }
  });
  complete(momentum);
  const Eigen::MatrixXd motion = inverse_ * momentum;
  parallel_for(displacement.cols(), 1, [&](std::size_t first, std::size_t last) {
    for (auto k = Eigen::Index(first); k < Eigen::Index(last); ++k) {
      Eigen::Map<Eigen::Matrix3Xd> u(displacement.col(k).data(), 3, n);
      const Eigen::Vector3d along = motion.col(k).head<3>(), about = motion.col(k).tail<3>();
      for (Eigen::Index i = 0; i < n; ++i) u.col(i) -= along + about.cross(place_m(node[std::size_t(i)]));
    }
  });
}

}  // namespace fem
