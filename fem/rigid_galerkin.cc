#include "fem/rigid_galerkin.h"

#include <Eigen/Dense>
#include <algorithm>

#include "fem/parallel.h"

namespace fem {

namespace {

template <typename T>
using Block33 = Eigen::Map<const Eigen::Matrix<T, 3, 3, Eigen::RowMajor>>;
using Matrix36 = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
using Matrix66 = Eigen::Matrix<double, 6, 6>;

/// Blocks of one row, gathered under their columns in any order.
template <typename Block>
class Row {
public:
  explicit Row(std::size_t n_columns) : place_(n_columns, -1) {}
  Block& operator[](std::int32_t column) {
    if (place_[column] < 0) {
      place_[column] = static_cast<std::int32_t>(columns_.size());
      columns_.push_back(column);
      if (columns_.size() > blocks_.size()) blocks_.emplace_back();
      blocks_[columns_.size() - 1].setZero();
    }
    return blocks_[place_[column]];
  }
  const std::vector<std::int32_t>& sorted_columns() {
    sorted_ = columns_;
    std::sort(sorted_.begin(), sorted_.end());
    return sorted_;
  }
  void clear() {
    for (const auto c : columns_) place_[c] = -1;
    columns_.clear();
  }

private:
  std::vector<std::int32_t> place_, columns_, sorted_;
  std::vector<Block, Eigen::aligned_allocator<Block>> blocks_;
};

/// A matrix of 3 x 6 blocks whose rows are made independently: fill(i, row) adds row i's blocks.
template <typename T, typename Fill>
BlockMatrix<T> make_rows(std::size_t n_rows, std::size_t n_columns, const Fill& fill) {
  constexpr std::size_t chunk = 4096;
  struct Piece {
    std::vector<std::int32_t> count, column;
    std::vector<T> block;
  };
  std::vector<Piece> pieces((n_rows + chunk - 1) / chunk);
  parallel_for(pieces.size(), 1, [&](std::size_t first, std::size_t last) {
    Row<Matrix36> row(n_columns);
    for (std::size_t p = first; p < last; ++p)
      for (std::size_t i = p * chunk; i < std::min(n_rows, (p + 1) * chunk); ++i) {
        fill(i, row);
        const auto& columns = row.sorted_columns();
        pieces[p].count.push_back(static_cast<std::int32_t>(columns.size()));
        for (const auto c : columns) {
          pieces[p].column.push_back(c);
          for (int e = 0; e < 18; ++e) pieces[p].block.push_back(static_cast<T>(row[c].data()[e]));
        }
        row.clear();
      }
  });
  BlockMatrix<T> result;
  result.height = 3;
  result.width = 6;
  result.n_columns = n_columns;
  result.begin.assign(1, 0);
  std::size_t n_blocks = 0;
  for (const auto& piece : pieces) n_blocks += piece.column.size();
  result.column.reserve(n_blocks);
  result.block.reserve(18 * n_blocks);
  for (auto& piece : pieces) {
    for (const auto count : piece.count) result.begin.push_back(result.begin.back() + count);
    result.column.insert(result.column.end(), piece.column.begin(), piece.column.end());
    result.block.insert(result.block.end(), piece.block.begin(), piece.block.end());
    piece = {};
  }
  return result;
}

}  // namespace

BlockMatrix<float> smoothed_interpolation(const BlockMatrix<double>& stiffness, const Aggregates& aggregates,
                                          const std::vector<double>& motions, double damping) {
  return make_rows<float>(stiffness.n_rows(), aggregates.n, [&](std::size_t i, Row<Matrix36>& row) {
    Eigen::Matrix3d diagonal;
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k) {
      const auto j = stiffness.column[k];
      const Block33<double> block(stiffness.at(k));
      if (j == std::int32_t(i)) diagonal = block;
      row[aggregates.of_node[j]] += block * Eigen::Map<const Matrix36>(&motions[18 * std::size_t(j)]);
    }
    const Eigen::Matrix3d scale = -damping * diagonal.inverse();
    for (const auto c : row.sorted_columns()) row[c] = (scale * row[c]).eval();
    row[aggregates.of_node[i]] += Eigen::Map<const Matrix36>(&motions[18 * i]);
  });
}

RigidGalerkin rigid_galerkin(const BlockMatrix<double>& stiffness, const BlockMatrix<float>& interpolation,
                             std::int32_t held) {
  const auto block_of = [](const BlockMatrix<float>& m, std::int64_t k) -> Matrix36 {
    return Eigen::Map<const Eigen::Matrix<float, 3, 6, Eigen::RowMajor>>(m.at(k)).cast<double>();
  };
  const auto image =
      make_rows<double>(stiffness.n_rows(), interpolation.n_columns, [&](std::size_t i, Row<Matrix36>& row) {
        for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k) {
          const auto j = stiffness.column[k];
          for (auto l = interpolation.begin[j]; l < interpolation.begin[j + 1]; ++l)
            row[interpolation.column[l]] += Block33<double>(stiffness.at(k)) * block_of(interpolation, l);
        }
      });
  // Nodes that an aggregate reaches, and where in the interpolation.
  const std::size_t n = interpolation.n_columns;
  std::vector<std::int64_t> begin(n + 1, 0);
  for (const auto a : interpolation.column) ++begin[a + 1];
  for (std::size_t a = 0; a < n; ++a) begin[a + 1] += begin[a];
  std::vector<std::int64_t> place(interpolation.column.size());
  std::vector<std::int32_t> node(place.size());
  auto next = begin;
  for (std::size_t i = 0; i < interpolation.n_rows(); ++i)
    for (auto k = interpolation.begin[i]; k < interpolation.begin[i + 1]; ++k) {
      const auto at = next[interpolation.column[k]]++;
      place[at] = k;
      node[at] = static_cast<std::int32_t>(i);
    }

  struct Column {
    std::vector<std::int32_t> row;
    std::vector<Matrix66, Eigen::aligned_allocator<Matrix66>> block;
  };
  std::vector<Column> columns(n);  // of blocks on and below the diagonal
  parallel_for(n, 64, [&](std::size_t first, std::size_t last) {
    Row<Matrix66> sums(n);
    for (std::size_t a = first; a < last; ++a) {
      sums[std::int32_t(a)];
      for (auto l = begin[a]; l < begin[a + 1] && std::int32_t(a) != held; ++l) {
        const Matrix36 p = block_of(interpolation, place[l]);
        for (auto k = image.begin[node[l]]; k < image.begin[node[l] + 1]; ++k)
          if (image.column[k] >= std::int32_t(a) && image.column[k] != held)
            sums[image.column[k]].noalias() += Eigen::Map<const Matrix36>(image.at(k)).transpose() * p;
      }
      columns[a].row = sums.sorted_columns();
      for (const auto row : columns[a].row) columns[a].block.push_back(sums[row]);
      auto& diagonal = columns[a].block.front();
      for (int c = 0; c < 6; ++c)
        if (!(diagonal(c, c) > 0)) diagonal(c, c) = 1;
      sums.clear();
    }
  });

  RigidGalerkin level;
  level.graph.begin.assign(1, 0);
  level.matrix.n = static_cast<std::int64_t>(6 * n);
  level.matrix.column_begin.assign(1, 0);
  for (std::size_t a = 0; a < n; ++a) {
    auto& column = columns[a];
    level.graph.neighbour.insert(level.graph.neighbour.end(), column.row.begin() + 1, column.row.end());
    level.graph.begin.push_back(static_cast<std::int64_t>(level.graph.neighbour.size()));
    for (int c = 0; c < 6; ++c) {
      for (std::size_t b = 0; b < column.row.size(); ++b)
        for (int r = b == 0 ? c : 0; r < 6; ++r) {
          level.matrix.row.push_back(6 * std::int64_t(column.row[b]) + r);
          level.matrix.value.push_back(column.block[b](r, c));
        }
      level.matrix.column_begin.push_back(static_cast<std::int64_t>(level.matrix.row.size()));
    }
    column = {};
  }
  return level;
}

std::unique_ptr<CholmodFactor> factorise(const RigidGalerkin& level) {
  std::vector<std::int32_t> order;  // two times three unknowns for each aggregate
  for (const auto a : order_nodes(level.graph)) {
    order.push_back(2 * a);
    order.push_back(2 * a + 1);
  }
  auto factor = std::make_unique<CholmodFactor>(level.matrix, order);
  factor->factorise(level.matrix);
  return factor;
}

}  // namespace fem
