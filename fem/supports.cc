#include "fem/supports.h"

#include <algorithm>
#include <vector>

namespace fem {

std::array<std::int64_t, 6> choose_supports(const Grid& grid) {
  std::vector<std::int32_t> corners;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : corner_nodes(grid.degree)) corners.push_back(grid.nodes_of(c)[i]);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());

  const auto at = [&](std::int32_t node) { return Eigen::Vector3d(grid.position(node)); };
  const auto farthest = [&](const auto& distance) {
    return *std::max_element(corners.begin(), corners.end(),
                             [&](auto i, auto j) { return distance(at(i)) < distance(at(j)); });
  };
  const Eigen::Vector3d start = at(corners.front());
  const auto a = farthest([&](const Eigen::Vector3d& x) { return (x - start).norm(); });
  const auto b = farthest([&](const Eigen::Vector3d& x) { return (x - at(a)).norm(); });
  const Eigen::Vector3d ab = at(b) - at(a);
  const auto c = farthest([&](const Eigen::Vector3d& x) { return ab.cross(x - at(a)).norm(); });

  int along = 0, across = 0;
  ab.cwiseAbs().maxCoeff(&along);
  ab.cross(at(c) - at(a)).cwiseAbs().maxCoeff(&across);
  std::array<std::int64_t, 6> unknowns{};
  for (int d = 0; d < 3; ++d) unknowns[d] = 3 * std::int64_t(a) + d;
  unknowns[3] = 3 * std::int64_t(b) + (along + 1) % 3;
  unknowns[4] = 3 * std::int64_t(b) + (along + 2) % 3;
  unknowns[5] = 3 * std::int64_t(c) + across;
  std::sort(unknowns.begin(), unknowns.end());
  return unknowns;
}

Supports::Supports(const std::array<std::int64_t, 6>& unknowns, SymmetricMatrix& matrix)
    : unknowns_(unknowns), rows_(Eigen::MatrixXd::Zero(6, matrix.n)) {
  const auto place = [&](std::int64_t i) {
    const auto it = std::lower_bound(unknowns_.begin(), unknowns_.end(), i);
    return it != unknowns_.end() && *it == i ? static_cast<int>(it - unknowns_.begin()) : -1;
  };
  for (std::int64_t j = 0; j < matrix.n; ++j) {
    const int column = place(j);
    for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k) {
      const auto i = matrix.row[k];
      const int row = i > unknowns_.back() ? -1 : place(i);
      if (row < 0 && column < 0) continue;
      if (row >= 0) rows_(row, j) = matrix.value[k];
      if (column >= 0) rows_(column, i) = matrix.value[k];
      if (i != j) matrix.value[k] = 0;
    }
  }
}

void Supports::clear(Eigen::MatrixXd& vectors) const {
  for (const auto i : unknowns_) vectors.row(i).setZero();
}

Eigen::MatrixXd Supports::reactions(const Eigen::MatrixXd& displacement, const Eigen::MatrixXd& force) const {
  Eigen::MatrixXd result = rows_ * displacement;
  for (int r = 0; r < 6; ++r) result.row(r) -= force.row(unknowns_[r]);
  return result;
}

}  // namespace fem
