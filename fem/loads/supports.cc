#include "fem/loads/supports.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fem/common/dense_algebra.h"

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
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  for (Eigen::Index s = 0; s < n; ++s) {
    const auto unknown = unknowns_[s];
    // The row left of the diagonal, spread over the columns before it ...
    for (std::int64_t j = 0; j < unknown; ++j) {
      const auto end = matrix.row.begin() + matrix.column_begin[j + 1];
      const auto found = std::lower_bound(matrix.row.begin() + matrix.column_begin[j], end, unknown);
      if (found == end || *found != unknown) continue;
      rows_(s, j) = matrix.value[found - matrix.row.begin()];
    }
    // ... and from the diagonal on the column itself.
    for (auto k = matrix.column_begin[unknown]; k < matrix.column_begin[unknown + 1]; ++k)
      rows_(s, matrix.row[k]) = matrix.value[k];
  }
  // Only then are they cleared: the rows of two supports cross.
  for (Eigen::Index s = 0; s < n; ++s) {
    const auto unknown = unknowns_[s];
    for (std::int64_t j = 0; j < unknown; ++j) {
      if (rows_(s, j) == 0) continue;
      const auto begin = matrix.row.begin() + matrix.column_begin[j];
      const auto found = std::lower_bound(begin, matrix.row.begin() + matrix.column_begin[j + 1], unknown);
      matrix.value[found - matrix.row.begin()] = 0;
    }
    for (auto k = matrix.column_begin[unknown] + 1; k < matrix.column_begin[unknown + 1]; ++k)
      matrix.value[k] = 0;
  }
}

void Supports::clear(Eigen::MatrixXd& vectors) const {
  for (const auto i : unknowns_) vectors.row(i).setZero();
}

Eigen::MatrixXd Supports::images(const Eigen::MatrixXd& displacement) const {
  return product(rows_, displacement);
}

}  // namespace fem
