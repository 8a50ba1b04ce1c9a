/// Which cells of a body of hexahedra a search cuts into eight: those that contribute most to the errors of
/// the places that may hold the largest stress.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/search/refinement/place_history.h"

namespace pipelines {

/// Whether a search refines the body locally: parametric bodies of hexahedra, where the program runs on one
/// rank.
bool is_refined_locally(const BodyScene& body);

struct LocalRefinement {
  std::vector<std::int32_t> cells;  ///< of the present mesh, ascending
  /// Nodes at weld toes whose faces would still be too long: cells there are cut once more.
  std::vector<std::array<double, 3>> again_at_m;
  std::vector<std::string> features;  ///< places whose own cells are among them
  std::vector<std::string> coarse;    ///< of these, fillets of few cells (MeshStep::coarse)
  /// By place, from what all cells contribute together.
  std::map<std::string, double> goal_errors_Pa;
};

/// The places whose errors are asked of all cells.
enum class GoalPlaces {
  leading,  ///< those that may hold the largest stress: of the others a second model knows
  all       ///< all whose error is not the stress itself (share_worth_a_look)
};

/// The places with at least the errors that follow from the contributions of all cells: what a stress changes
/// by from step to step is blind to cells that no step has cut, and what single cells tell to all that is
/// wrong further away. Beside the toes of a web, on a tube of 4 mm that cells of 30 mm had stiffened, the
/// stress was 2.2 % off, single cells said 0.25 %, and no step had cut a cell for it; the goal says 3.4 %.
std::vector<PlaceStress> with_goal_errors(std::vector<PlaceStress> judged, const LocalRefinement& local);

/// For each place that may lead, by its stress and error, the stress there is a goal: on surfaces a mean of
/// von Mises stress at the instant of its maximum, weighted so that it follows the maximum smoothly; at weld
/// toes the extrapolated hot-spot stress. The product of the errors of the load case and of the goal's dual
/// solution (fem::Model::goal_errors_Pa) says what each cell contributes. Cut are the cells that together
/// contribute the larger part to any of the goals, and those at the places themselves; twice at weld toes
/// among the goals whose faces one cut leaves too long.
/// @param model       that the analysis' responses are of
/// @param by_changes  the places with their errors so far, not empty
/// @param places      whose errors by goals are wanted; one that may lead with that error is cut for, too
/// @param tolerance   of the largest stress, relative: no more is cut than it needs; 0: none
LocalRefinement cells_to_cut(const fem::Model& model, const Judged& analysis,
                             const std::vector<PlaceStress>& by_changes, GoalPlaces places, double tolerance);

/// Cuts them: a further cycle of body.refinements.
/// @return nothing if there are none
std::optional<MeshStep> refine_locally(BodyScene& body, const LocalRefinement& local);

/// The body's mesh. Where cells that were cut come out inverted beside larger ones, these are cut too, in
/// further cycles of body.refinements.
/// @param mesh  makes the mesh of the body as it is
/// @throws what `mesh` throws; fem::InvertedBesideLarger if ten cycles do not mend it
MeshedBody mesh_refined(BodyScene& body, const std::function<MeshedBody()>& mesh);

}  // namespace pipelines
