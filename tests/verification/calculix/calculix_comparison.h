/// Our unit responses beside those that CalculiX computes with the same mesh and loads (calculix_model.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fem/equations/loads/nodal_loads.h"
#include "tests/verification/calculix/calculix_results.h"

namespace pipelines {

/// Largest von Mises stress of one load on the surfaces looked at, with its error as a run estimates it: the
/// stress of that cell at the node which differs most.
struct NodalStress {
  double von_mises_Pa = 0, error_Pa = 0;
};

/// One unit load in both codes.
struct CalculixAgreement {
  std::string channel;
  /// sqrt of the integral of |u - u_ccx|^2 over that of |u|^2, both without rigid motion.
  double displacement_difference = 0;
  /// Work f'u: Galerkin solutions of one load on nested spaces; ours is not the smaller one, and what the
  /// difference leaves of ours is the square of the relative difference in the energy norm.
  double compliance_J = 0, calculix_compliance_J = 0;
  std::size_t node = 0;  ///< where our stress is largest, among those that both have
  NodalStress ours, calculix;
};

/// @param boundary_ids  boundary ids of the surfaces whose largest stress is compared
/// @throws std::invalid_argument if loads, responses and results have not the same loads and nodes, or no
/// node lies on the surfaces
std::vector<CalculixAgreement> compare_with_calculix(const fem::UnitResponses& ours,
                                                     const fem::NodalLoads& loads,
                                                     const CalculixResults& calculix,
                                                     const fem::Material& material,
                                                     const std::vector<int>& boundary_ids);

}  // namespace pipelines
