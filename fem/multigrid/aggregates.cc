#include "fem/multigrid/aggregates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/common/dense_algebra.h"

namespace fem {

namespace {

// Relative to the largest: motions below are rounding. Rotation about a far axis leaves some 1e-3.
constexpr double least_motion = 1e-8;

using Motions = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;

/// Neighbours with the strength of their coupling in units of the threshold; weak ones are left out.
struct Couplings {
  std::vector<std::size_t> begin;
  std::vector<std::pair<std::int32_t, double>> to;
};

Couplings strong_couplings(const BlockMatrix<double>& stiffness, int siblings, double threshold) {
  const std::size_t n = stiffness.n_rows() / siblings;
  Couplings all{{0}, {}};
  std::vector<double> size(n), sum(n, 0.0);
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < n; ++i) {
    found.clear();
    for (auto row = i * siblings; row < (i + 1) * siblings; ++row)
      for (auto k = stiffness.begin[row]; k < stiffness.begin[row + 1]; ++k) {
        const auto j = stiffness.column[k] / siblings;
        if (sum[j] == 0) found.push_back(j);
        sum[j] += Eigen::Map<const Eigen::Array<double, 9, 1>>(stiffness.at(k)).square().sum() + 1e-300;
      }
    std::sort(found.begin(), found.end());
    size[i] = std::sqrt(sum[i]);
    for (const auto j : found) {
      if (j != std::int32_t(i)) all.to.emplace_back(j, sum[j]);
      sum[j] = 0;
    }
    all.begin.push_back(all.to.size());
  }
  Couplings strong{{0}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    for (auto k = all.begin[i]; k < all.begin[i + 1]; ++k) {
      const auto& [j, square] = all.to[k];
      const double strength = square / (threshold * threshold * size[i] * size[j]);
      if (strength > 1) strong.to.emplace_back(j, strength);
    }
    strong.begin.push_back(strong.to.size());
  }
  return strong;
}

}  // namespace

Aggregates aggregate_nodes(const BlockMatrix<double>& stiffness, int siblings, double threshold) {
  const auto strong = strong_couplings(stiffness, siblings, threshold);
  const std::size_t n = strong.begin.size() - 1;
  Aggregates result;
  std::vector<std::int32_t> of_node(n, -1);
  const auto gather = [&](std::size_t i) {
    of_node[i] = std::int32_t(result.n);
    for (auto k = strong.begin[i]; k < strong.begin[i + 1]; ++k)
      if (of_node[strong.to[k].first] < 0) of_node[strong.to[k].first] = std::int32_t(result.n);
    ++result.n;
  };
  // Nodes with all their strong neighbours ...
  for (std::size_t i = 0; i < n; ++i) {
    bool free = of_node[i] < 0 && strong.begin[i + 1] > strong.begin[i];
    for (auto k = strong.begin[i]; free && k < strong.begin[i + 1]; ++k)
      free = of_node[strong.to[k].first] < 0;
    if (free) gather(i);
  }
  // ... the rest joins the neighbour that holds it most, if that was among them ...
  const auto first = of_node;
  for (std::size_t i = 0; i < n; ++i) {
    if (of_node[i] >= 0) continue;
    double best = 0;
    for (auto k = strong.begin[i]; k < strong.begin[i + 1]; ++k)
      if (first[strong.to[k].first] >= 0 && strong.to[k].second > best) {
        best = strong.to[k].second;
        of_node[i] = first[strong.to[k].first];
      }
  }
  // ... or groups of its own.
  for (std::size_t i = 0; i < n; ++i)
    if (of_node[i] < 0) gather(i);
  for (const auto a : of_node) result.of_node.insert(result.of_node.end(), siblings, a);
  return result;
}

std::vector<double> rigid_motions(const std::vector<double>& xyz_m) {
  const Eigen::Map<const Eigen::Matrix3Xd> place(xyz_m.data(), 3, Eigen::Index(xyz_m.size() / 3));
  const Eigen::Vector3d centre = place.rowwise().mean();
  const double radius_m = std::max((place.colwise() - centre).colwise().norm().maxCoeff(), 1e-300);
  std::vector<double> motions(6 * xyz_m.size());
  for (Eigen::Index i = 0; i < place.cols(); ++i) {
    const Eigen::Vector3d x = (place.col(i) - centre) / radius_m;
    Eigen::Map<Motions> m(motions.data() + 18 * i);
    m.leftCols<3>().setIdentity();
    m.rightCols<3>() << 0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0;
  }
  return motions;
}

AggregateMotions span_motions(const Aggregates& aggregates, const std::vector<double>& motions) {
  std::vector<std::vector<std::int32_t>> nodes(aggregates.n);
  for (std::size_t i = 0; i < aggregates.of_node.size(); ++i)
    nodes[aggregates.of_node[i]].push_back(std::int32_t(i));
  AggregateMotions result;
  result.basis.assign(motions.size(), 0.0);
  result.motion.assign(36 * aggregates.n, 0.0);
  for (std::size_t a = 0; a < aggregates.n; ++a) {
    const auto n = Eigen::Index(nodes[a].size());
    Eigen::MatrixXd of_aggregate(3 * n, 6);
    for (Eigen::Index i = 0; i < n; ++i)
      of_aggregate.middleRows<3>(3 * i) = Eigen::Map<const Motions>(&motions[18 * std::size_t(nodes[a][i])]);
    const Eigen::MatrixXd span = orthonormal_basis(of_aggregate, least_motion);
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(3 * n, 6);
    basis.leftCols(span.cols()) = span;
    for (Eigen::Index i = 0; i < n; ++i)
      Eigen::Map<Motions>(result.basis.data() + 18 * std::size_t(nodes[a][i])) = basis.middleRows<3>(3 * i);
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(result.motion.data() + 36 * a) =
        transposed_product(basis, of_aggregate);
    result.rank.push_back(static_cast<int>(span.cols()));
  }
  return result;
}

}  // namespace fem
