/// What a solver is given and gives. Internal to fem.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/solver_choice.h"
#include "fem/mesh/grid/grid.h"
#include "fem/mesh/grid/rigid_modes.h"

namespace fem {

using StepReport = std::function<void(double, const std::string&)>;  ///< as Progress of model.h

/// Load vectors, without resultants unless clamps hold the body, and the sizes of those as applied. A
/// balanced one may vanish (a uniform acceleration), and is no scale.
struct BalancedLoads {
  Eigen::MatrixXd force;
  std::vector<std::int64_t> clamped;  ///< unknowns that clamps hold, ascending; none on a free body
  /// Unknowns of a statically determinate support beside the clamps, ascending. A free body has that of
  /// choose_supports.
  std::vector<std::int64_t> supports{};
  Eigen::RowVectorXd norm, largest_entry;
};

/// Powers of two that bring the largest entry of each column to size 1, so that squares of neither small nor
/// large loads leave the range of numbers, and no bit changes; 1 for a column of zeros.
Eigen::RowVectorXd to_unit_size(const Eigen::MatrixXd& force);

/// Takes their resultants out, unless clamps hold the body.
BalancedLoads balance(const RigidBalance& rigid, const std::vector<std::int64_t>& clamped,
                      Eigen::MatrixXd force);

/// Rounding alone leaves eps |K| |u| / |f|, up to 1e-9 in slender bodies: refinement cannot go below that.
inline constexpr double acceptable_residual = 1e-8;

/// What is told of a solution.
struct SolutionFigures {
  double residual = 0;          ///< largest |K u - f| / |f|
  double rounding = 0;          ///< as SolverReport
  double support_reaction = 0;  ///< largest, over the load vector's largest entry; 0 without supports
  double factor_gigabytes = 0;
  FactorSize factor{};
  double bytes = 0;  ///< taken by the solver
  int n_iterations = 0;
  bool is_even = false;  ///< found on one half of the body, of which the other is the mirror image
};

struct Solution : SolutionFigures {
  Eigen::MatrixXd displacement{};  ///< of the loads, with any rigid motion
  std::vector<RankWork> ranks{};   ///< as SolverReport
};

}  // namespace fem
