#include "fem/equations/loads/supports.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fem/base/common/dense_algebra.h"

namespace fem {

std::vector<std::int32_t> free_corners(const Grid& grid) {
  std::vector<std::int32_t> corners;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const int i : corner_nodes(grid.shape())) corners.push_back(grid.nodes_of(c)[i]);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto& hanging = grid.hanging.node;
  corners.erase(
      std::remove_if(corners.begin(), corners.end(),
                     [&](auto node) { return std::binary_search(hanging.begin(), hanging.end(), node); }),
      corners.end());
  return corners;
}

std::array<std::int64_t, 6> choose_supports(const Grid& grid) {
  const auto corners = free_corners(grid);
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

Supports::Supports(std::vector<std::int64_t> unknowns, SymmetricMatrix& matrix)
    : unknowns_(std::move(unknowns)), rows_(Eigen::MatrixXd::Zero(unknowns_.size(), matrix.n)) {
  std::vector<std::int32_t> place(std::size_t(matrix.n), -1);  // among the supported unknowns
  for (std::size_t s = 0; s < unknowns_.size(); ++s) place[std::size_t(unknowns_[s])] = std::int32_t(s);
  for (std::int64_t j = 0; j < matrix.n; ++j)
    for (auto k = matrix.column_begin[j]; k < matrix.column_begin[j + 1]; ++k) {
      const auto i = matrix.row[k];
      if (place[i] < 0 && place[j] < 0) continue;
      if (place[i] >= 0) rows_(place[i], j) = matrix.value[k];
      if (place[j] >= 0) rows_(place[j], i) = matrix.value[k];
      if (i != j) matrix.value[k] = 0;
    }
}

Eigen::MatrixXd Supports::images(const Eigen::MatrixXd& displacement) const {
  return product(rows_, displacement);
}

}  // namespace fem
