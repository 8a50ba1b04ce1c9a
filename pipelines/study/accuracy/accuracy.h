/// What accuracy costs in time: one body of a scene on every model, from beam to solid, against a
/// reference.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/study/accuracy/grid_convergence.h"
#include "pipelines/study/effects/effect_prices.h"

namespace pipelines {

/// One run of one model.
struct AccuracyRow {
  /// "beam", "axisymmetric", "shell", "Q1 solid", "even mesh" (Q2 solid), "Q3 solid", "systematic mesh",
  /// "refined mesh", "fewer instants"
  std::string model;
  std::string fineness;  ///< in words
  int instants_per_turn = 0;
  std::size_t n_dofs = 0;
  double value_Pa = 0;               ///< governing stress (refinement.h)
  double principal_Pa = 0;           ///< largest principal stress outside the exclusion distances
  ErrorBudget errors;                ///< errors of the governing stress
  std::vector<StageCost> stages;     ///< what this run itself took; a refined mesh: all steps up to it
  double seconds = 0, spread_s = 0;  ///< mean and range over the repeats
  double gigabytes = 0;              ///< largest resident memory during the run
  double true_error_Pa = 0;          ///< |value - reference|
  bool is_reference = false;
  bool on_frontier = false;      ///< no cheaper run is closer to the reference, as far as that is known
  bool is_contradicted = false;  ///< further from the reference than both state: one of the two is wrong
};

/// A model or mesh that was not run.
struct LeftOutModel {
  std::string model;  ///< "even mesh, cells 1/2"
  std::string why;    ///< what refused it said
};

/// Up to three systematic meshes of one body, coarsest first, and what they say together.
struct GridStudy {
  struct Mesh {
    std::string fineness;
    std::size_t n_dofs = 0;
    double size_m = 0;    ///< size of its cells (systematic_meshes.h)
    double value_Pa = 0;  ///< largest stress, between nodes too; or the hot-spot stress
  };
  std::vector<Mesh> meshes;
  GridConvergence convergence;  ///< refused with fewer than two meshes
  /// Excess over the finest mesh's peak, which is that at a node; 0 for hot spots.
  double between_nodes_Pa = 0;

  /// How far the finest mesh's peak may be from the largest stress of an infinitely fine mesh.
  double index_Pa() const { return convergence.index_21 + between_nodes_Pa; }
};

/// Estimated over true error; infinite where the run meets the reference exactly.
double effectivity(const AccuracyRow& row);

struct AccuracyStudy {
  std::string body, quantity;
  std::vector<AccuracyRow> rows;  ///< cheapest first
  double reference_Pa = 0;
  double reference_error_Pa = 0;      ///< error of an overkill run by its own budget; 0: a known value
  std::string reference;              ///< what it is, in words
  double tolerance = 0;               ///< relative
  std::optional<std::size_t> chosen;  ///< cheapest row whose estimate is within the tolerance
  std::string next_factor_of_two;     ///< a sentence
  std::vector<EffectPrice> effects;   ///< prices of the effects on the scene's own mesh
  std::optional<GridStudy> grid;      ///< where it was asked for
  std::vector<LeftOutModel> left_out;
};

/// Takes a known value as reference, or the run with the smallest estimate; sorts the runs by their seconds,
/// marks the efficient frontier and the runs that the reference contradicts, chooses the cheapest of the
/// others within the tolerance and prices the next factor of two.
/// @param known_Pa  0: not known
/// @throws ToleranceNotMet for a study without runs
void compare_runs(AccuracyStudy& study, double known_Pa);

struct AccuracyOptions {
  int n_threads = 0;
  double time_limit_s = 120;      ///< limit of the study of one body; what does not end in time is left out
  double tolerance = 0;           ///< 0: the scene's, or 5 %
  int n_repeats = 1;              ///< repeats of every run that takes less than a tenth of the time
  double reference_Pa = 0;        ///< a known value; 0: an overkill run
  bool grid_convergence = false;  ///< three systematic meshes too
};

/// Runs all models of one body, cheapest first: beam and axisymmetric harmonics (round shafts), the scene's
/// mesh from half as fine to several times finer, with fewer instants, and meshes refined where stress asks
/// for it; where asked for, systematic meshes, the finest of which has the grid convergence index as its
/// discretisation error. It ends at a tenth of the tolerance, by the estimates, or when the time is up: what
/// would not end in time, or does not, is among those left out, but for the first run. The
/// run with the smallest estimate is what the others are compared with, unless a value is known. Needs an
/// fem::Environment.
AccuracyStudy study_accuracy(const Scene& scene, std::size_t body, const AccuracyOptions& options,
                             StageClock& clock);

}  // namespace pipelines
