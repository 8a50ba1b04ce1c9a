#include "pipelines/base/fatigue/fatigue_material.h"

#include <algorithm>
#include <stdexcept>

#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {

const std::vector<GroupConstants>& material_groups() {
  using G = MaterialGroup;
  constexpr auto none = std::nullopt;
  // f_W,sigma, f_W,tau | a_M, b_M | a_R, R_m,N,min | a_G, b_G | K_f~ | casting, brittle | k, N_D, k_II
  static const std::vector<GroupConstants> groups = {
      {G::steel, "steel", 0.45, 0.577, 0.35, -0.10, 0.22, 400, 0.50, 2700, 2.0, false, false, 5, 1e6, none},
      {G::stainless_steel, "stainless steel", 0.40, 0.577, 0.35, -0.10, 0.22, 400, 0.40, 2400, 2.0, false,
       false, 5, 1e6, 15},
      {G::case_hardening_steel, "case-hardening steel", 0.40, 0.577, 0.35, -0.10, 0.22, 400, 0.50, 2700, 2.0,
       false, false, 5, 1e6, none},
      {G::forging_steel, "forging steel", 0.40, 0.577, 0.35, -0.10, 0.22, 400, 0.50, 2700, 2.0, false, false,
       5, 1e6, none},
      {G::cast_steel, "cast steel", 0.34, 0.577, 0.35, 0.05, 0.20, 400, 0.25, 2000, 2.0, true, false, 5, 1e6,
       none},
      {G::ductile_cast_iron, "ductile cast iron", 0.34, 0.65, 0.35, 0.08, 0.16, 400, 0.05, 3200, 1.5, true,
       false, 5, 1e6, none},
      {G::malleable_cast_iron, "malleable cast iron", 0.30, 0.75, 0.35, 0.13, 0.12, 350, -0.05, 3200, 1.2,
       true, true, 5, 1e6, none},
      {G::grey_cast_iron, "grey cast iron", 0.34, 1.0, 0, 0.50, 0.06, 100, -0.05, 3200, 1.0, true, true, 5,
       1e6, none},
      {G::wrought_aluminium, "wrought aluminium", 0.30, 0.577, 1.0, -0.04, 0.22, 133, 0.05, 850, 2.0, false,
       false, 5, 1e6, 15},
      {G::cast_aluminium, "cast aluminium", 0.30, 0.75, 1.0, 0.20, 0.20, 133, -0.05, 3200, 1.2, true, false,
       5, 1e6, 15}};
  return groups;
}

const GroupConstants& constants_of(MaterialGroup group) {
  return material_groups().at(std::size_t(group));
}

void require_sound(const FatigueMaterial& material) {
  require_positive_input("tensile_strength_Pa", material.tensile_strength_Pa);
  require_input_between("tensile_strength_Pa", material.tensile_strength_Pa, 1e6, 3e9);
  require_positive_input("yield_strength_Pa", material.yield_strength_Pa);
  if (material.yield_strength_Pa > material.tensile_strength_Pa)
    refuse_fatigue_input("yield_strength_Pa", material.yield_strength_Pa,
                         "must not be above tensile_strength_Pa");
  if (material.elongation) require_input_between("elongation", *material.elongation, 0, 1);
}

double reversed_strength_Pa(const FatigueMaterial& material) {
  require_sound(material);
  return constants_of(material.group).f_W_sigma * material.tensile_strength_Pa;
}

}  // namespace pipelines
