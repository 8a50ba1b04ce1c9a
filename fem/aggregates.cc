#include "fem/aggregates.h"

#include <Eigen/Dense>
#include <cmath>

namespace fem {

namespace {

// Squared lengths, relative to the largest: motions below are not told apart.
constexpr double least_motion = 1e-6;

using Block = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
using Motions = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;

Motions motions_at(const Eigen::Vector3d& x) {
  Motions m;
  m.leftCols<3>().setIdentity();
  m.rightCols<3>() << 0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0;
  return m;
}

}  // namespace

Aggregates aggregate_nodes(const BlockMatrix<double>& stiffness, double threshold) {
  const std::size_t n = stiffness.n_rows();
  std::vector<double> size(n);
  for (std::size_t i = 0; i < n; ++i)
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k)
      if (stiffness.column[k] == std::int32_t(i)) size[i] = Block(stiffness.at(k)).norm();
  // Strength in units of the threshold; 0: weak, or the node itself.
  const auto strength = [&](std::size_t i, std::int64_t k) {
    const auto j = std::size_t(stiffness.column[k]);
    const double s =
        Block(stiffness.at(k)).squaredNorm() / (threshold * threshold * size[i] * size[j] + 1e-300);
    return j != i && s > 1 ? s : 0.0;
  };
  Aggregates result;
  result.of_node.assign(n, -1);
  auto& of_node = result.of_node;
  const auto gather = [&](std::size_t i) {
    of_node[i] = std::int32_t(result.n);
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k)
      if (of_node[stiffness.column[k]] < 0 && strength(i, k) > 0)
        of_node[stiffness.column[k]] = std::int32_t(result.n);
    ++result.n;
  };
  // Nodes with all their strong neighbours ...
  for (std::size_t i = 0; i < n; ++i) {
    bool free = of_node[i] < 0, alone = true;
    for (auto k = stiffness.begin[i]; free && k < stiffness.begin[i + 1]; ++k)
      if (strength(i, k) > 0) {
        alone = false;
        free = of_node[stiffness.column[k]] < 0;
      }
    if (free && !alone) gather(i);
  }
  // ... the rest joins the neighbour that holds it most, if that was among them ...
  const std::vector<std::int32_t> first = of_node;
  for (std::size_t i = 0; i < n; ++i) {
    double best = 0;
    if (of_node[i] >= 0) continue;
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k)
      if (first[stiffness.column[k]] >= 0 && strength(i, k) > best) {
        best = strength(i, k);
        of_node[i] = first[stiffness.column[k]];
      }
  }
  // ... or groups of its own.
  for (std::size_t i = 0; i < n; ++i)
    if (of_node[i] < 0) gather(i);
  return result;
}

std::vector<double> rigid_motions(const Aggregates& aggregates, const std::vector<double>& xyz_m,
                                  std::vector<int>& rank) {
  const std::size_t n = aggregates.of_node.size();
  struct Sum {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double n_nodes = 0, radius_squared = 0;
    Eigen::Matrix<double, 6, 6> products = Eigen::Matrix<double, 6, 6>::Zero(), basis;
  };
  std::vector<Sum> sums(aggregates.n);
  const auto place = [&](std::size_t i) { return Eigen::Vector3d(&xyz_m[3 * i]); };
  for (std::size_t i = 0; i < n; ++i) {
    auto& sum = sums[aggregates.of_node[i]];
    sum.centre += place(i);
    sum.n_nodes += 1;
  }
  for (auto& sum : sums) sum.centre /= sum.n_nodes;
  for (std::size_t i = 0; i < n; ++i) {
    auto& sum = sums[aggregates.of_node[i]];
    sum.radius_squared += (place(i) - sum.centre).squaredNorm() / sum.n_nodes;
  }
  // Rotations by displacements of size 1 at the aggregate's radius.
  const auto motions = [&](std::size_t i, const Sum& sum) {
    return motions_at((place(i) - sum.centre) / std::sqrt(sum.radius_squared + 1e-300));
  };
  for (std::size_t i = 0; i < n; ++i) {
    auto& sum = sums[aggregates.of_node[i]];
    const Motions m = motions(i, sum);
    sum.products += m.transpose() * m;
  }
  rank.assign(aggregates.n, 0);
  for (std::size_t a = 0; a < aggregates.n; ++a) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(sums[a].products);
    const auto& length_squared = solver.eigenvalues();
    sums[a].basis.setZero();
    for (int m = 0; m < 6; ++m)
      if (length_squared[m] > least_motion * length_squared[5]) {
        sums[a].basis.col(m) = solver.eigenvectors().col(m) / std::sqrt(length_squared[m]);
        ++rank[a];
      }
  }
  std::vector<double> blocks(18 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& sum = sums[aggregates.of_node[i]];
    Eigen::Map<Motions>(blocks.data() + 18 * i) = motions(i, sum) * sum.basis;
  }
  return blocks;
}

}  // namespace fem
