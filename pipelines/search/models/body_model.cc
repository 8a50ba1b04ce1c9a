#include "pipelines/search/models/body_model.h"

#include <utility>

#include "pipelines/judge/stages/body_vibration.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/judge/stages/superpose_body.h"

namespace pipelines {

Loaded BodyModel::loaded_with(const Scene& scene, MeshedBody mesh) const {
  auto all = loaded_.meshed;
  all[run_.index] = std::move(mesh);
  return run_.load(scene, std::move(all));
}

BodyAnalysis BodyModel::superposed_again(BodyAnalysis& before) const {
  return superpose_again(body(), meshed(), body_loads(), before, !run_.options.keep_factor,
                         run_.options.n_threads, clock());
}

BodyAnalysis BodyModel::again(BodyAnalysis& before) {
  auto after = superposed_again(before);
  after.search = std::move(before.search);
  after.vibration = std::move(before.vibration);
  enter_vibration(after);
  take_torsion_by_harmonics(before, after);
  take_place_errors(after, before.place_stresses, "as found by the body's search");
  return after;
}

}  // namespace pipelines
