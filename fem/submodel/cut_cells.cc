#include "fem/submodel/cut_cells.h"

#include <stdexcept>

namespace fem {

GridField cut_into_eight(const GridField& coarse) {
  if (coarse.grid.degree != 2) throw std::invalid_argument("cut_into_eight: the cells are not of degree 2");
  return coarse.grid.kind == CellKind::tetrahedra ? cut_tetrahedra(coarse) : cut_hexahedra(coarse);
}

RowMajor with_rows_below(const RowMajor& old_values, const std::vector<Eigen::RowVectorXd>& new_values) {
  RowMajor all(old_values.rows() + Eigen::Index(new_values.size()), old_values.cols());
  all.topRows(old_values.rows()) = old_values;
  for (std::size_t i = 0; i < new_values.size(); ++i)
    all.row(old_values.rows() + Eigen::Index(i)) = new_values[i];
  return all;
}

}  // namespace fem
