/// What a search makes finer next: where the place is that keeps the error of the whole body large, and what
/// of its mesh promises most there.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/search/refinement/place_history.h"

namespace pipelines {

/// Whether a body is a parametric shaft of hexahedra.
bool is_block_shaft(const BodyScene& body);

/// The parts of a body's mesh that a search varies one at a time.
std::vector<MeshPart> mesh_parts(const BodyScene& body);

/// All of the own estimate of tetrahedra is kept: it has no margin to give away (tetrahedra_estimate.h). Of
/// that of a chamber, whose meshes were seen to agree at 41 MPa where finer ones have 38, all that single
/// cells differ by after one change, half of that after more; both without the safety factor of 3. Of a
/// shaft's that is refined locally the same, since two meshes with 90 MPa stood beside 92.7. And a shaft's
/// first mesh leaves 12 % open: near the end of one that spins it had 17.7 +- 0.8 MPa, 19.3 is right,
/// and 16.6 +- 0.9 on the end, 14.9 is right. But not on fillets of fine cells (tests/evidence/promises.md,
/// first meshes).
TrustInMeshes trust_in_meshes(const BodyScene& body);

/// Meshes that a search may begin with, the first one that the mesher takes: shafts with 2 cells on every
/// fillet quarter and 8 sectors, then with more sectors and cells; other bodies with cells half as large
/// again as the scene's, chambers that are refined locally before that with lean ones; the scene's own mesh
/// last.
std::vector<BodyScene> first_meshes(const BodyScene& body);

/// For a STEP file: four meshes with ever larger cells, from those of first_meshes on, by factors of 1.5.
/// Other bodies: none.
std::vector<BodyScene> first_meshes_in_time(const BodyScene& body);

/// For tetrahedra: the body with cells smaller by 4, 9 and 15 %, for a mesh that is refused for a few of its
/// cells: which ones come out flat is chance. Other bodies: none.
std::vector<BodyScene> nearly_as_fine(const BodyScene& body);

/// A shaft's first mesh with 6 cells on the fillets that a second model finds to be stressed most, 4 on those
/// with more than half of that stress.
BodyScene guided_by(const SecondModel& model, const BodyScene& body);

/// More instants and more pressure harmonics where these dominate the governing stress's error budget, or
/// reach a third of its largest entry. As many instants as bring the entry down to that third, by its order
/// or by the spectra of the factors, between 1.5 and 8 times those of before.
/// @param loads  of the body, over the present instants
struct OtherRefinement {
  bool possible = false;     ///< something of the two became finer
  bool mesh_matters = true;  ///< the mesh dominates
};
OtherRefinement refine_sampling_and_harmonics(Scene& scene, std::size_t index, const GoverningStress& stress,
                                              const ChannelHistory& loads);

/// Makes the mesh finer where the place that holds the error back feels it most: `part` of a shaft's mesh (on
/// those fillets only whose stress with its error could be the largest); weld toes of a chamber, half as
/// large where the hot-spot stress with its error could be the largest, and one more cell through its walls;
/// the surface of a body of tetrahedra that may hold the largest stress (solid_refinement.h). The order is 1
/// for a chamber: at a right re-entrant corner stress grows like r^(lambda - 1), and what that does to places
/// further away falls like h^(2 lambda), lambda = 0.544.
/// @param judged  the places with all that is known of their errors
/// @return nothing if that part cannot be finer
std::optional<MeshStep> refine_mesh(BodyScene& body, const Judged& analysis,
                                    const std::vector<PlaceStress>& judged, MeshPart part);

/// Whether a stress keeps growing like a power of the cell size: over the last two refinements its exponent,
/// ln(v2 / v1) / ln(ratio), has fallen by less than a quarter and is above 0.1. That of a stress that
/// converges with second order falls by ratio^2 at each step.
/// @param values, ratios  of the steps so far at one place; ratios[i] leads from values[i] to values[i + 1]
bool grows_without_bound(const std::vector<double>& values, const std::vector<double>& ratios);

/// Why a search takes no further step; empty: it takes one.
/// @param of_blocks  shafts of hexahedra: elsewhere a stress may grow for some steps before its edge is left
/// out
std::string reason_to_end(const Search& search, const GoverningStress& stress, bool of_blocks);

/// Whether the last five steps of a search have lowered the error by less than a tenth, all of them together.
bool stands_still(const Search& search);

/// Two meshes tell more than one. If cells became `ratio` times smaller and the stress changed by d, about
/// d / (ratio^order - 1) is missing still (order 2 or better for recovered stress of quadratic cells on round
/// fillets). The discretisation entry becomes that, or a share of what single cells differ by if that is
/// more: two meshes may agree by chance, each further one makes that less likely.
/// @param n_meshes  tried so far: all of what single cells differ by for two, half beyond
void learn_from_change(ErrorBudget& budget, double change_Pa, double ratio, int n_meshes = 3,
                       double order = 2);

}  // namespace pipelines
