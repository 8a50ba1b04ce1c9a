/// Running a body again and again until its headline stress is known well enough: what dominates the error is
/// refined, everything else stays coarse.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/body_analysis.h"
#include "pipelines/scene.h"

namespace pipelines {

/// The stress that a tolerance refers to: the hot-spot stress of the worst weld toe where a body has weld
/// toes, else its peak von Mises stress.
struct GoverningStress {
  std::string name;  ///< "peak von Mises stress", "hot-spot stress"
  std::string place;
  double value_Pa = 0;
  ErrorLedger errors;

  /// Numerical part, relative; 0 where nothing is stressed.
  double relative_error() const { return value_Pa > 0 ? errors.numerical_Pa() / value_Pa : 0; }
};
GoverningStress governing_stress(const BodyAnalysis& analysis);

/// What of a mesh a step makes finer.
enum class MeshPart { all, fillets, around };

/// What is missing still of a shaft's stress for want of cells on its fillets, and of cells around and along
/// it: each as its own last change has told.
struct Remainders {
  std::optional<double> fillets_Pa, around_Pa;
  int n_fillet_steps = 0;  ///< in which cells of fillets became smaller

  void learn(MeshPart part, double missing_Pa);
  /// Of the other parts than that one; 0 where nothing is known.
  double of_others(MeshPart part) const;
  /// What is worth a step: fillets for two steps, then what is around them once, then what has more missing.
  MeshPart next() const;
};

/// What the next step changes.
struct Refinement {
  bool possible = false;
  bool new_mesh = false;
  double ratio = 1;  ///< of cell sizes at the governing place, before : after
  double order = 2;  ///< at least, with which the governing stress converges with that size
  MeshPart part = MeshPart::all;
};

/// The coarsest mesh that a search begins with: 2 cells on every fillet quarter and 8 sectors; cells half as
/// large again as the scene's on other bodies.
BodyScene coarsest(const BodyScene& body);

/// Mends what dominates the governing stress's ledger, and what reaches a third of that: more instants, more
/// pressure harmonics, smaller cells. Cells of a shaft become smaller on those fillets only whose stress with
/// its error could be the peak; all round once that no longer helps. Chambers get one more cell through their
/// walls, and cells half as large at the weld toes whose hot-spot stress with its error could be the largest;
/// elsewhere cells shrink a little. The order is 1 there: at a right re-entrant corner stress grows like
/// r^(lambda - 1), and what that does to places further away falls like h^(2 lambda), lambda = 0.544. Bodies
/// of tetrahedra get a fine spot at the peak. The sequence of meshes does not depend on a tolerance, so that
/// a stricter one never costs less.
Refinement refine(Scene& scene, std::size_t body, const BodyAnalysis& analysis, const Remainders& known);

/// Whether a stress keeps growing like a power of the cell size: over the last two refinements its exponent,
/// ln(v2 / v1) / ln(ratio), has fallen by less than a quarter and is above 0.1. That of a stress that
/// converges with second order falls by ratio^2 at each step.
/// @param values, ratios  of the steps so far at one place; ratios[i] leads from values[i] to values[i + 1]
bool grows_without_bound(const std::vector<double>& values, const std::vector<double>& ratios);

/// What earlier meshes have told of the discretisation holds on the same mesh with more instants or
/// harmonics.
void keep_discretisation(ErrorLedger& ledger, const ErrorLedger& before);

/// Two meshes tell more than one. If cells became `ratio` times smaller and the stress changed by d, about
/// d / (ratio^order - 1) is missing still (order 2 or better for recovered stress of quadratic cells on round
/// fillets). The
/// discretisation entry becomes that, or a share of what single cells differ by if that is more: two meshes
/// may agree by chance, each further one makes that less likely.
/// @param n_meshes  tried so far: all of what single cells differ by for two, half beyond
/// @param others_Pa  missing for want of other things than those that became smaller: added
/// @return what is missing as the change tells it, without that
double learn_from_change(ErrorLedger& ledger, double change_Pa, double ratio, int n_meshes = 3,
                         double order = 2, double others_Pa = 0);

}  // namespace pipelines
