/// Materials of the cells of a mesh. Internal to fem.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fem/mesh/grid.h"
#include "fem/operators/stiffness.h"
#include "fem/values/body.h"

namespace fem {

/// What a body is made of: one material everywhere, or several kinds by volume group.
class CellMaterials {
public:
  /// One material everywhere.
  CellMaterials(const Material& everywhere) : kinds_{everywhere} {}  // NOLINT(google-explicit-constructor)
  /// Body::material, and Body::material_of_volume where a group has its own. Equal materials are one kind.
  /// @throws std::invalid_argument for impossible values, or a group without cells
  CellMaterials(const Grid& grid, const Body& body);

  bool is_uniform() const noexcept { return kinds_.size() == 1; }
  /// Index of the cell's material.
  int kind(std::size_t cell) const { return kind_of_cell_ ? (*kind_of_cell_)[cell] : 0; }
  const Material& operator[](std::size_t cell) const { return kinds_[kind(cell)]; }

  double largest_modulus_Pa() const;
  double largest_poisson_ratio() const;
  /// Lame's constants of the cells, in units of `modulus_Pa`.
  PerCell<Lame> elastic(double modulus_Pa = 1) const;
  PerCell<double> density_kg_m3() const;
  /// In units of `unit_kg_m3`.
  PerCell<double> density(double unit_kg_m3) const;

private:
  std::vector<Material> kinds_;
  std::shared_ptr<const std::vector<std::int32_t>> kind_of_cell_;  // none: one kind
};

}  // namespace fem
