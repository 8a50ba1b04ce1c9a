/// Stresses of a body of revolution on a section much finer than a run's, as the truth that its stated errors
/// are held against.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/loads/stage/load_stage.h"

namespace harmonics {

struct StrictStress {
  double value_Pa = 0;                    ///< von Mises, the largest over the cycle
  std::array<double, 2> position_zr_m{};  ///< where that is
};

struct StrictStresses {
  std::map<std::string, StrictStress>
      places;  ///< by feature of the surface, under all harmonics of the pressures
  /// The same under those up to a harmonic: by that harmonic, of `highest` of strict_stresses.
  std::map<int, std::map<std::string, double>> truncated_Pa;
  double torsion_Pa = 0;  ///< largest torsional stress
  std::size_t n_dofs = 0;
};

/// Cells of degree 4 (a run's have 3) around fillets, ends of loaded seats, the borders of what is left out,
/// and the places given: they grow with the distance from these. Half planes resolve the square of every
/// harmonic, so that the von Mises stress between them follows from its own Fourier series. Nothing of this
/// is shared with the run's refinement, its interpolation or its estimate.
/// @param scene    its first body is the shaft, with as many harmonics as the truth shall have
/// @param highest  harmonics that StrictStresses::truncated_Pa ends with
/// @param peaks_m  z, r of places that want fine cells
/// @param growth   of cells with their distance from what they are fine at
StrictStresses strict_stresses(const pipelines::Scene& scene, const std::set<int>& highest,
                               const std::vector<std::array<double, 2>>& peaks_m, double growth = 0.6);

}  // namespace harmonics
