#include "pipelines/search/models/body_model.h"

#include <utility>

#include "pipelines/judge/stages/body_vibration.h"
#include "pipelines/judge/stages/judge_body.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/judge/stages/shaft_torsion.h"
#include "pipelines/respond/responses/respond.h"

namespace pipelines {

Loaded BodyModel::loaded_with(const Scene& scene, MeshedBody mesh) const {
  auto all = loaded_.meshed;
  all[run_.index] = std::move(mesh);
  return run_.load(scene, std::move(all));
}

Judged BodyModel::judged(Responded responded, const MeshedBody& meshed, std::optional<Envelope> known) const {
  const int n_threads = run_.options.n_threads;
  auto superposed = superpose(std::move(responded), threads(n_threads), clock(), std::move(known));
  return judge_body(std::move(superposed), meshed, !run_.options.keep_factor, n_threads, clock());
}

Judged BodyModel::judged_again(Judged& before) const {
  return judge_again(body(), meshed(), body_loads(), before, !run_.options.keep_factor,
                     run_.options.n_threads, clock());
}

Judged BodyModel::again(Judged& before) {
  auto after = judged_again(before);
  after.search = std::move(before.search);
  after.vibration = std::move(before.vibration);
  enter_vibration(after);
  after.critical_speeds = std::move(before.critical_speeds);
  take_torsion_by_harmonics(before, after);
  take_place_errors(after, before.place_stresses, "as found by the body's search");
  return after;
}

}  // namespace pipelines
