/// The models of an accuracy study, one function for each kind. They return their rows, cheapest first.
#pragma once

#include <vector>

#include "pipelines/study/accuracy/accuracy_bench.h"

namespace pipelines {

/// Beam and axisymmetric harmonics of round shafts; a thin shell for the weld toes of parametric chambers.
std::vector<AccuracyRow> cheap_models(AccuracyBench& bench);

struct SolidModels {
  std::vector<AccuracyRow> rows;
  /// Prices of the effects on the scene's own mesh; empty if it could not be run.
  std::vector<EffectPrice> effects;
};

/// The scene's mesh from half as fine to several times finer, and its own with fewer instants.
SolidModels even_meshes(AccuracyBench& bench);

/// What `run --tolerance` would do for a tenth of the tolerance, step by step.
std::vector<AccuracyRow> refined_meshes(AccuracyBench& bench);

struct SystematicModels {
  /// The finest with the index as its discretisation error, unless it is refused.
  std::vector<AccuracyRow> rows;
  GridStudy study;
};

/// Three systematic meshes; a fourth takes the place of the coarsest if they are not in the asymptotic range
/// and time is left.
SystematicModels systematic_meshes(AccuracyBench& bench);

}  // namespace pipelines
