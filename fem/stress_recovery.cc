#include "fem/stress_recovery.h"

#include "fem/cell_geometry.h"
#include "fem/parallel.h"

namespace fem {

namespace {

/// Rows 3 q + d of the displacement gradient (derivative along d) to stress rows.
void hooke(const Lame& elastic, const RowMajor& gradient, int n_points, Eigen::Ref<RowMajor> stress) {
  const Eigen::Index n_loads = gradient.cols() / 3;
  for (int q = 0; q < n_points; ++q)
    for (Eigen::Index k = 0; k < n_loads; ++k) {
      const auto g = [&](int component, int along) { return gradient(3 * q + along, 3 * k + component); };
      const double dilatation = elastic.lambda_Pa * (g(0, 0) + g(1, 1) + g(2, 2));
      double* s = &stress(q, 6 * k);
      for (int d = 0; d < 3; ++d) s[d] = dilatation + 2 * elastic.mu_Pa * g(d, d);
      s[3] = elastic.mu_Pa * (g(0, 1) + g(1, 0));
      s[4] = elastic.mu_Pa * (g(1, 2) + g(2, 1));
      s[5] = elastic.mu_Pa * (g(0, 2) + g(2, 0));
    }
}

/// Stress of one cell at the tabulated points; keeps its work space from cell to cell.
class CellStress {
public:
  CellStress(const Grid& grid, const Tabulation& at, const Lame& elastic, const ConstBlock& displacement)
      : grid_(grid), at_(at), elastic_(elastic), displacement_(displacement) {}

  void operator()(std::size_t cell, Eigen::Ref<RowMajor> stress) {
    compute_gradients(grid_, cell, at_, gradients_);
    local_.resize(at_.n_shapes, displacement_.cols());
    for (int i = 0; i < at_.n_shapes; ++i) local_.row(i) = displacement_.row(grid_.nodes_of(cell)[i]);
    gradient_.noalias() = gradients_.gradient * local_;
    hooke(elastic_, gradient_, at_.n_points, stress);
  }

private:
  const Grid& grid_;
  const Tabulation& at_;
  Lame elastic_;
  const ConstBlock& displacement_;
  CellGradients gradients_;
  RowMajor local_, gradient_;
};

}  // namespace

RowMajor stress_at_points(const Grid& grid, const Tabulation& at, const Lame& elastic,
                          const ConstBlock& displacement) {
  RowMajor stress(grid.n_cells() * at.n_points, 2 * displacement.cols());
  parallel_for(grid.n_cells(), 32, [&](std::size_t begin, std::size_t end) {
    CellStress compute(grid, at, elastic, displacement);
    for (std::size_t c = begin; c < end; ++c) compute(c, stress.middleRows(c * at.n_points, at.n_points));
  });
  return stress;
}

void average_stress(const Grid& grid, const CellsOfNodes& cells, const Lame& elastic,
                    const ConstBlock& displacement, Eigen::Ref<RowMajor> stress) {
  const Tabulation at = nodes_in_cell(grid.degree);
  stress.setZero();
  for (const auto& group : colour_cells(grid, cells))
    parallel_for(group.size(), 16, [&](std::size_t begin, std::size_t end) {
      CellStress compute(grid, at, elastic, displacement);
      RowMajor local(at.n_points, stress.cols());
      for (std::size_t c = begin; c < end; ++c) {
        compute(group[c], local);
        for (int i = 0; i < at.n_points; ++i) stress.row(grid.nodes_of(group[c])[i]) += local.row(i);
      }
    });
  for (std::size_t i = 0; i < grid.n_nodes; ++i) stress.row(i) /= double(cells.begin[i + 1] - cells.begin[i]);
}

}  // namespace fem
