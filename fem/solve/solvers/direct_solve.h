/// Unit responses by one factorisation on a statically determinate support. Internal to fem.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <vector>

#include "fem/equations/loads/balanced_loads.h"
#include "fem/equations/matrices/cholmod_factor.h"
#include "fem/equations/operators/stiffness.h"

namespace fem {

/// The unknowns of a body in the order of elimination, and the shape of its factor: known from the mesh
/// alone, found on one thread.
struct PlannedFactor {
  PlannedFactor(const Grid& grid, const CellsOfNodes& cells);

  std::unique_ptr<CholmodFactor> factor;
  NodeGraph graph;                  ///< of the nodes in the factor's order
  std::vector<std::int32_t> place;  ///< of each of the grid's nodes in that order
};

/// The factor of a body's stiffness with its supports or clamps, for further loads.
class FactorisedBody {
public:
  FactorisedBody() = default;
  FactorisedBody(const FactorisedBody&) = delete;
  FactorisedBody& operator=(const FactorisedBody&) = delete;
  virtual ~FactorisedBody() = default;

  /// Displacements of loads without resultants, with some rigid motion.
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& force) const = 0;

  /// Whether what is not mirrored of other loads is left out (mirrored_halves.h).
  virtual bool takes_even_loads_only() const { return false; }

  /// Whether every MPI rank has a part of it, and all call solve together.
  virtual bool is_on_all_ranks() const { return false; }
};

/// The size of the stiffness' factor, without computing it.
FactorSize analyse_factor(const Grid& grid, const CellsOfNodes& cells);

struct DirectSolveOptions {
  std::future<PlannedFactor> plan{};                      ///< if it was begun before
  std::shared_ptr<const FactorisedBody>* kept = nullptr;  ///< if given, holds the factor afterwards
};

/// @throws DoesNotFit if the analysed factor is larger than the memory that is free
/// @throws SolveFailed as CholmodFactor, or if rounding reaches more than 1 % of displacements
Solution solve_directly(const Grid& grid, const CellsOfNodes& cells,
                        const std::vector<std::vector<std::int32_t>>& colours, const PerCell<Lame>& elastic,
                        const BalancedLoads& loads, const StepReport& progress,
                        DirectSolveOptions options = {});

/// The largest share of a load case's displacement that the correction is; of those cases that need one.
double rounding(const Eigen::MatrixXd& rest, const Eigen::MatrixXd& correction,
                const Eigen::MatrixXd& displacement, const BalancedLoads& loads);

/// @throws SolveFailed naming the remedy if it is more than 1 %
void refuse_rounding(const Grid& grid, double share);

}  // namespace fem
