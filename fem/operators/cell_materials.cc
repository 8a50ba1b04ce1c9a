#include "fem/operators/cell_materials.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace fem {

namespace {

bool same(const Material& a, const Material& b) {
  return a.youngs_modulus_Pa == b.youngs_modulus_Pa && a.poisson_ratio == b.poisson_ratio &&
         a.density_kg_m3 == b.density_kg_m3;
}

template <typename T, typename Get>
PerCell<T> per_cell(const std::vector<Material>& kinds,
                    const std::shared_ptr<const std::vector<std::int32_t>>& kind_of_cell, const Get& get) {
  std::vector<T> values;
  for (const auto& material : kinds) values.push_back(get(material));
  return {std::move(values), kind_of_cell};
}

}  // namespace

CellMaterials::CellMaterials(const Grid& grid, const Body& body) {
  std::map<int, std::int32_t> kind_of_volume;
  const auto add = [&](const Material& material) {
    refuse_impossible(material);
    const auto known =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const auto& other) { return same(material, other); });
    if (known != kinds_.end()) return static_cast<std::int32_t>(known - kinds_.begin());
    kinds_.push_back(material);
    return static_cast<std::int32_t>(kinds_.size() - 1);
  };
  add(body.material);
  for (const auto& [volume, material] : body.material_of_volume) {
    if (std::find(grid.volume_id.begin(), grid.volume_id.end(), volume) == grid.volume_id.end())
      throw std::invalid_argument("material_of_volume[" + std::to_string(volume) +
                                  "]: the mesh has no cells in this volume group");
    kind_of_volume[volume] = add(material);
  }
  if (is_uniform()) return;
  std::vector<std::int32_t> kinds;
  kinds.reserve(grid.n_cells());
  for (const int volume : grid.volume_id) {
    const auto own = kind_of_volume.find(volume);
    kinds.push_back(own == kind_of_volume.end() ? 0 : own->second);
  }
  kind_of_cell_ = std::make_shared<const std::vector<std::int32_t>>(std::move(kinds));
}

double CellMaterials::largest_modulus_Pa() const {
  double largest = 0;
  for (const auto& m : kinds_) largest = std::max(largest, m.youngs_modulus_Pa);
  return largest;
}

double CellMaterials::largest_poisson_ratio() const {
  double largest = -1;
  for (const auto& m : kinds_) largest = std::max(largest, m.poisson_ratio);
  return largest;
}

PerCell<Lame> CellMaterials::elastic(double modulus_Pa) const {
  return per_cell<Lame>(kinds_, kind_of_cell_, [&](const Material& m) {
    return lame({m.youngs_modulus_Pa / modulus_Pa, m.poisson_ratio, m.density_kg_m3});
  });
}

PerCell<double> CellMaterials::density_kg_m3() const {
  return density(1);
}

PerCell<double> CellMaterials::density(double unit_kg_m3) const {
  return per_cell<double>(kinds_, kind_of_cell_,
                          [&](const Material& m) { return m.density_kg_m3 / unit_kg_m3; });
}

}  // namespace fem
