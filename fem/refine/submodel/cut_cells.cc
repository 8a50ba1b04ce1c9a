#include "fem/refine/submodel/cut_cells.h"

#include <stdexcept>

namespace fem {

GridField cut_into_eight(const GridField& coarse) {
  if (coarse.grid.degree != 2) throw std::invalid_argument("cut_into_eight: the cells are not of degree 2");
  return coarse.grid.kind == CellKind::tetrahedra ? cut_tetrahedra(coarse) : cut_hexahedra(coarse);
}

NewNodes::NewNodes(const GridField& coarse, const ReferencePoints& places)
    : coarse_(coarse), at_(tabulate_in_cell(coarse.grid.shape(), places)) {}

void NewNodes::append(const std::int32_t* nodes, std::size_t place) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::RowVectorXd value = Eigen::RowVectorXd::Zero(coarse_.field.cols());
  for (int i = 0; i < at_.n_shapes; ++i) {
    const double share = at_.value[place * std::size_t(at_.n_shapes) + std::size_t(i)];
    x += share * Eigen::Map<const Eigen::Vector3d>(coarse_.grid.position(nodes[i]));
    value += share * coarse_.field.row(nodes[i]);
  }
  xyz_m_.insert(xyz_m_.end(), x.data(), x.data() + 3);
  values_.push_back(value);
}

void NewNodes::add_to(GridField& fine) const {
  const auto n_old = coarse_.field.rows(), n_new = Eigen::Index(values_.size());
  fine.grid.n_nodes = std::size_t(n_old + n_new);
  fine.grid.xyz_m = coarse_.grid.xyz_m;
  fine.grid.xyz_m.insert(fine.grid.xyz_m.end(), xyz_m_.begin(), xyz_m_.end());
  fine.field.resize(n_old + n_new, coarse_.field.cols());
  fine.field.topRows(n_old) = coarse_.field;
  for (Eigen::Index i = 0; i < n_new; ++i) fine.field.row(n_old + i) = values_[std::size_t(i)];
}

}  // namespace fem
