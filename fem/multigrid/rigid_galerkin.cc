#include "fem/multigrid/rigid_galerkin.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "fem/common/parallel.h"
#include "fem/loads/clamps.h"

namespace fem {

namespace {

template <typename T>
using Block33 = Eigen::Map<const Eigen::Matrix<T, 3, 3, Eigen::RowMajor>>;
using Matrix36 = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
using Matrix66 = Eigen::Matrix<double, 6, 6>;

/// A thread has the products of so many at hand.
constexpr std::size_t aggregates_at_once = 512;

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
                                          const std::vector<double>& basis, double damping) {
  return make_rows<float>(stiffness.n_rows(), aggregates.n, [&](std::size_t i, Row<Matrix36>& row) {
    Eigen::Matrix3d diagonal;
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k) {
      const auto j = stiffness.column[k];
      const Block33<double> block(stiffness.at(k));
      if (j == std::int32_t(i)) diagonal = block;
      row[aggregates.of_node[j]] += block * Eigen::Map<const Matrix36>(&basis[18 * std::size_t(j)]);
    }
    const Eigen::Matrix3d scale = -damping * diagonal.inverse();
    for (const auto c : row.sorted_columns()) row[c] = (scale * row[c]).eval();
    row[aggregates.of_node[i]] += Eigen::Map<const Matrix36>(&basis[18 * i]);
  });
}

BlockMatrix<double> galerkin_product(const BlockMatrix<double>& stiffness,
                                     const BlockMatrix<float>& interpolation) {
  const auto block_of = [](const BlockMatrix<float>& m, std::int64_t k) -> Matrix36 {
    return Eigen::Map<const Eigen::Matrix<float, 3, 6, Eigen::RowMajor>>(m.at(k)).cast<double>();
  };
  /// K P in the row of a node.
  const auto add_image = [&](std::size_t i, Row<Matrix36>& row) {
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k) {
      const auto j = stiffness.column[k];
      for (auto l = interpolation.begin[j]; l < interpolation.begin[j + 1]; ++l)
        row[interpolation.column[l]] += Block33<double>(stiffness.at(k)) * block_of(interpolation, l);
    }
  };
  const auto restriction = transpose(interpolation);  // blocks 6 x 3
  const std::size_t n = restriction.n_rows();
  struct BlockRow {
    std::vector<std::int32_t> column;
    std::vector<Matrix66, Eigen::aligned_allocator<Matrix66>> block;
  };
  std::vector<BlockRow> rows(n);
  const auto make_rows_of = [&](std::size_t first, std::size_t last) {
    // K P of the nodes that these aggregates move, and no more: all of it takes twice the stiffness.
    std::vector<std::int32_t> moved(restriction.column.begin() + restriction.begin[first],
                                    restriction.column.begin() + restriction.begin[last]);
    std::sort(moved.begin(), moved.end());
    moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
    const auto image = make_rows<double>(
        moved.size(), n, [&](std::size_t i, Row<Matrix36>& row) { add_image(std::size_t(moved[i]), row); });
    Row<Matrix66> sums(n);
    for (std::size_t a = first; a < last; ++a) {
      for (auto l = restriction.begin[a]; l < restriction.begin[a + 1]; ++l) {
        const Eigen::Matrix<double, 6, 3> p =
            Eigen::Map<const Eigen::Matrix<float, 6, 3, Eigen::RowMajor>>(restriction.at(l)).cast<double>();
        const auto node = std::lower_bound(moved.begin(), moved.end(), restriction.column[l]) - moved.begin();
        for (auto k = image.begin[node]; k < image.begin[node + 1]; ++k)
          sums[image.column[k]].noalias() += p * Eigen::Map<const Matrix36>(image.at(k));
      }
      auto& diagonal = sums[std::int32_t(a)];
      for (int c = 0; c < 6; ++c)
        if (!(diagonal(c, c) > 0)) diagonal(c, c) = 1;
      rows[a].column = sums.sorted_columns();
      for (const auto c : rows[a].column) rows[a].block.push_back(sums[c]);
      sums.clear();
    }
  };
  const std::size_t n_groups = (n + aggregates_at_once - 1) / aggregates_at_once;
  parallel_for(n_groups, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group)
      make_rows_of(group * aggregates_at_once, std::min(n, (group + 1) * aggregates_at_once));
  });
  BlockMatrix<double> result;
  result.n_columns = 2 * n;
  result.begin.assign(1, 0);
  for (auto& row : rows) {
    for (int half = 0; half < 2; ++half) {
      for (std::size_t b = 0; b < row.column.size(); ++b)
        for (int other = 0; other < 2; ++other) {
          result.column.push_back(2 * row.column[b] + other);
          for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) result.block.push_back(row.block[b](3 * half + r, 3 * other + c));
        }
      result.begin.push_back(static_cast<std::int64_t>(result.column.size()));
    }
    row = {};
  }
  return result;
}

std::unique_ptr<CholmodFactor> factorise_held(const BlockMatrix<double>& stiffness, std::int32_t held) {
  NodeGraph graph;
  graph.begin.assign(1, 0);
  for (std::size_t i = 0; i < stiffness.n_rows(); ++i) {
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k)
      if (stiffness.column[k] > std::int32_t(i)) graph.neighbour.push_back(stiffness.column[k]);
    graph.begin.push_back(static_cast<std::int64_t>(graph.neighbour.size()));
  }
  SymmetricMatrix matrix = make_matrix(graph);
  for (std::size_t i = 0; i < stiffness.n_rows(); ++i)
    for (auto k = stiffness.begin[i]; k < stiffness.begin[i + 1]; ++k)
      if (stiffness.column[k] >= std::int32_t(i))
        add_block(graph, std::int32_t(i), stiffness.column[k], Block33<double>(stiffness.at(k)), matrix);
  std::vector<std::int64_t> fast(6);
  std::iota(fast.begin(), fast.end(), 6 * std::int64_t(held));
  clamp(fast, matrix);
  auto factor = std::make_unique<CholmodFactor>(graph, order_nodes(graph));
  factor->factorise(matrix);
  return factor;
}

}  // namespace fem
