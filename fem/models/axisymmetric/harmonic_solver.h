/// Stiffness of the harmonics, one factorisation each. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/equations/matrices/symmetric_matrix.h"
#include "fem/models/axisymmetric/meridian_grid.h"

namespace fem {

/// What the stiffness matrices of all harmonics have in common: which nodes meet, and a good order of them.
struct HarmonicPattern {
  NodeGraph graph;
  std::vector<std::int32_t> order;

  explicit HarmonicPattern(const MeridianGrid& grid);
};

/// Solves one harmonic after the other; several solvers may share a grid and its pattern.
class HarmonicSolver {
public:
  // Arguments have to outlive this object.
  HarmonicSolver(const MeridianGrid& grid, const HarmonicPattern& pattern, const Material& material);

  /// Displacement amplitudes of the load columns of one harmonic; those of m = 0 and 1 have no resultants,
  /// and get some rigid motion. On the axis displacements are single-valued: U = V = 0 at m = 0, U + V = W =
  /// 0 at m = 1, none beyond.
  /// @param residual  becomes the larger of itself and the largest |K u - f| / |f|
  /// @throws SolveFailed if the factorisation fails
  Eigen::MatrixXd solve(int m, const Eigen::MatrixXd& force, double& residual);

private:
  void assemble(int m, const std::vector<std::int64_t>& held);
  std::vector<std::int64_t> held_unknowns(int m) const;

  const MeridianGrid* grid_;
  Material material_;
  const HarmonicPattern* pattern_;
  SymmetricMatrix matrix_;  // of the harmonic solved last
  CholmodFactor factor_;
};

}  // namespace fem
