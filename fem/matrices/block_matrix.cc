#include "fem/matrices/block_matrix.h"

#include "fem/common/parallel.h"

namespace fem {

namespace {

/// Begins of rows from the number of entries in each, which stand at the place of the next one.
void sum_up(std::vector<std::int64_t>& begin) {
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) begin[i + 1] += begin[i];
}

}  // namespace

BlockMatrix<double> full_rows(const NodeGraph& graph, const SymmetricMatrix& matrix) {
  const std::size_t n = graph.n_nodes();
  BlockMatrix<double> result;
  result.n_columns = n;
  result.begin.assign(n + 1, 0);
  for (std::size_t j = 0; j < n; ++j) {
    result.begin[j + 1] += 1 + graph.begin[j + 1] - graph.begin[j];
    for (auto k = graph.begin[j]; k < graph.begin[j + 1]; ++k) ++result.begin[graph.neighbour[k] + 1];
  }
  sum_up(result.begin);
  result.column.resize(result.begin.back());
  result.block.resize(9 * result.column.size());
  // Column after column fills every row from the left: first what is below the diagonal of earlier columns.
  std::vector<std::int64_t> next(result.begin.begin(), result.begin.end() - 1);
  using Block = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  for (std::size_t j = 0; j < n; ++j)
    for_blocks_of(matrix, j, [&](std::int32_t i, const Eigen::Matrix3d& block) {
      const auto right = next[j]++, left = std::size_t(i) == j ? right : next[i]++;
      result.column[right] = i;
      result.column[left] = static_cast<std::int32_t>(j);
      Block(result.at(left)) = block;
      Block(result.at(right)) = block.transpose();
    });
  return result;
}

BlockMatrix<float> to_float(const BlockMatrix<double>& matrix) {
  return {matrix.height, matrix.width,  matrix.n_columns,
          matrix.begin,  matrix.column, {matrix.block.begin(), matrix.block.end()}};
}

BlockMatrix<float> transpose(const BlockMatrix<float>& matrix) {
  BlockMatrix<float> result;
  result.height = matrix.width;
  result.width = matrix.height;
  result.n_columns = matrix.n_rows();
  result.begin.assign(matrix.n_columns + 1, 0);
  for (const auto c : matrix.column) ++result.begin[c + 1];
  sum_up(result.begin);
  result.column.resize(matrix.column.size());
  result.block.resize(matrix.block.size());
  std::vector<std::int64_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t i = 0; i < matrix.n_rows(); ++i)
    for (auto k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k) {
      const auto place = next[matrix.column[k]]++;
      result.column[place] = static_cast<std::int32_t>(i);
      for (int r = 0; r < matrix.height; ++r)
        for (int c = 0; c < matrix.width; ++c)
          result.at(place)[c * matrix.height + r] = matrix.at(k)[r * matrix.width + c];
    }
  return result;
}

}  // namespace fem
