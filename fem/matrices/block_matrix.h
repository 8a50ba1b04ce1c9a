/// Sparse matrices of small dense blocks. Internal to fem.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/common/elastic_kernel.h"
#include "fem/matrices/symmetric_matrix.h"

namespace fem {

/// Block rows, their columns ascending.
template <typename T>
struct BlockMatrix {
  int height = 3, width = 3;  ///< of a block
  std::size_t n_columns = 0;  ///< of blocks
  std::vector<std::int64_t> begin;
  std::vector<std::int32_t> column;
  std::vector<T> block;  ///< height x width numbers each, row after row

  std::size_t n_rows() const noexcept { return begin.size() - 1; }
  std::size_t block_size() const noexcept { return std::size_t(height) * width; }
  const T* at(std::int64_t k) const { return block.data() + block_size() * k; }
  T* at(std::int64_t k) { return block.data() + block_size() * k; }
  std::size_t bytes() const noexcept {
    return begin.size() * 8 + column.size() * 4 + block.size() * sizeof(T);
  }
};

inline kernel::BlockRows view(const BlockMatrix<float>& m) {
  return {m.height, m.width, m.begin.data(), m.column.data(), m.block.data()};
}

/// Of blocks of 1 x 1.
inline kernel::NodeRows node_view(const BlockMatrix<float>& m) {
  return {m.begin.data(), m.column.data(), m.block.data()};
}

/// Both triangles of the stiffness of a graph of nodes, in 3 x 3 blocks.
BlockMatrix<double> full_rows(const NodeGraph& graph, const SymmetricMatrix& matrix);

BlockMatrix<float> to_float(const BlockMatrix<double>& matrix);
BlockMatrix<float> transpose(const BlockMatrix<float>& matrix);

}  // namespace fem
