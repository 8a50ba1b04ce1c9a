/// Stiffness of the harmonics, one factorisation each. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <memory>

#include "fem/body.h"
#include "fem/cholmod_factor.h"
#include "fem/meridian_grid.h"
#include "fem/symmetric_matrix.h"

namespace fem {

class HarmonicSolver {
public:
  HarmonicSolver(const MeridianGrid& grid, const Material& material);

  /// Displacement amplitudes of the load columns of one harmonic; those of m = 0 and 1 have no resultants,
  /// and get some rigid motion. On the axis displacements are single-valued: U = V = 0 at m = 0, U + V = W =
  /// 0 at m = 1, none beyond.
  /// @param residual  becomes the larger of itself and the largest |K u - f| / |f|
  /// @throws SolveFailed if the factorisation fails
  Eigen::MatrixXd solve(int m, const Eigen::MatrixXd& force, double& residual);

private:
  void assemble(int m, const std::vector<char>& held);
  std::vector<char> held_unknowns(int m) const;

  const MeridianGrid* grid_;
  Material material_;
  NodeGraph graph_;
  SymmetricMatrix matrix_;  // of the harmonic solved last
  std::unique_ptr<CholmodFactor> factor_;
};

}  // namespace fem
