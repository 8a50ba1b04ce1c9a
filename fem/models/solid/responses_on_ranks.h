/// Unit responses of a body that several MPI ranks share: each has the rows of some nodes. Internal to fem.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"
#include "fem/equations/loads/elastic_supports.h"
#include "fem/mesh/grid/rigid_modes.h"
#include "fem/solve/solvers/solve_on_ranks.h"

namespace fem {

/// A mesh with the nodes that stress has.
struct SeenMesh {
  const Grid& grid;
  const CellsOfNodes& cells;
  const std::vector<std::int32_t> copy;  ///< of its last nodes: which of the body's each is a copy of
  const NodeIntegrals& volumes;
};

struct SharedLoads {
  const std::vector<UnitLoad>& unit_loads;
  const ElasticSupports& springs;
  const std::vector<std::int64_t>& clamped;  ///< unknowns
  const Body& body;
  const NodeIntegrals& integrals;
};

/// What a solution tells beside displacements.
/// @param n_columns  load cases that were solved
void take_report(const Solution& solution, std::size_t n_columns, UnitResponses& responses);

/// The loads of a part: balanced on the whole body, a few at a time, then its rows.
/// @param resultants  filled, if given: of the unit loads as applied
BalancedLoads loads_of_part(const BodyOnRanks& body, const SharedLoads& loads, const RankPart& part,
                            Eigen::RowVectorXd& scale, std::vector<std::array<double, 6>>* resultants);

/// Fills all of the responses but sections and rings. Called on all ranks.
/// @param responses  with channels and the choice of the solver
/// @param kept       as solve_on_ranks; may be null
void respond_on_ranks(const BodyOnRanks& body, const HalfOfBody& half_of_body, const SeenMesh& seen,
                      const SharedLoads& loads, bool by_patches, const StepReport& progress,
                      const SolverChoice& choice, std::shared_ptr<const FactorisedBody>* kept,
                      UnitResponses& responses);

}  // namespace fem
