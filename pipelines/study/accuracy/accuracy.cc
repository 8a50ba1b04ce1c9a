#include "pipelines/study/accuracy/accuracy.h"

#include <utility>

#include "pipelines/study/accuracy/accuracy_models.h"

namespace pipelines {

AccuracyStudy study_accuracy(const Scene& scene, std::size_t body, const AccuracyOptions& options,
                             StageClock& clock) {
  AccuracyBench bench(scene, body, options, clock);
  AccuracyStudy study;
  study.body = bench.body().name;
  study.quantity = bench.has_hot_spots() ? "hot-spot stress" : "peak von Mises stress";
  study.tolerance = bench.tolerance();
  const auto add = [&](const std::vector<AccuracyRow>& rows) {
    study.rows.insert(study.rows.end(), rows.begin(), rows.end());
  };
  add(cheap_models(bench));
  if (options.grid_convergence) {  // first: it was asked for
    auto systematic = systematic_meshes(bench);
    add(systematic.rows);
    study.grid = std::move(systematic.study);
  }
  auto solids = even_meshes(bench);
  add(solids.rows);
  study.effects = std::move(solids.effects);
  add(refined_meshes(bench));
  study.left_out = bench.left_out();
  compare_runs(study, options.reference_Pa);
  return study;
}

}  // namespace pipelines
