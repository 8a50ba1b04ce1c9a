#include "pipelines/search/loop/search.h"

#include <new>
#include <optional>
#include <utility>

#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/estimates/in_time.h"

namespace pipelines {
namespace {

void record(const BodyModel& model, const Judged& judged, std::size_t index, double seconds, Search& search) {
  const auto stress = governing_stress(judged);
  const auto& scene = model.loaded().scene;
  search.quantity = stress.name();
  search.steps.push_back({model.fineness(), model.refined(), stress.place, scene.sampling.instants_per_turn,
                          scene.bodies[index].pressure_harmonics, judged.responses.n_dofs, stress.value_Pa,
                          stress.errors, judged.envelope.principal.value_Pa[judged.principal_node], seconds,
                          peak_memory_gigabytes()});
}

void compare_with_tolerance(const Judged& judged, Search& search) {
  const auto stress = governing_stress(judged);
  search.steps.back().errors = stress.errors;
  search.met = search.tolerance == 0 || stress.errors.reducible_Pa() <= search.tolerance * stress.value_Pa;
}

/// A finer model, solved, unless that would not end in time or does not fit into memory: then why.
std::optional<Judged> solved(BodyModel& finer, double seconds_left, std::string& why_not) {
  const auto without_finer_mesh = [&](const std::string& why) {
    why_not = "a finer mesh could not be solved: " + why;
    return std::nullopt;
  };
  std::optional<Judged> result;
  try {
    if (!in_time(seconds_left, [&] { result = finer.solve(); })) why_not = time_is_up;
  } catch (const fem::DoesNotFit& error) {
    return without_finer_mesh(error.what());
  } catch (const std::bad_alloc&) {  // what is taken beside the solver's own
    return without_finer_mesh("it does not fit into memory");
  }
  return result;
}

/// The next finer model and its stress; none: `search` says why.
std::optional<Judged> next(std::unique_ptr<BodyModel>& model, const Judged& judged, const RunOfBody& run,
                           Search& search) {
  auto finer = model->finer(judged, search);
  search.ended = finer.why_not;
  if (finer.seconds > 0) search.next_seconds = finer.seconds;
  if (!finer.model) return std::nullopt;
  const double left_s = run.seconds_left() - finer.model->seconds_after();
  if (finer.seconds > left_s) {
    search.ended = time_is_up;
    return std::nullopt;
  }
  if (2 * finer.seconds <= left_s) model->release();  // it is not likely to be returned to
  auto result = solved(*finer.model, run.seconds_left(), search.ended);
  if (!result) return std::nullopt;
  finer.model->judge(*result);
  model = std::move(finer.model);
  return result;
}

}  // namespace

Judged search(std::unique_ptr<BodyModel>& model, const RunOfBody& run) {
  Search search;
  search.tolerance = run.tolerance;
  search.time_limit_s = run.time_limit_s;
  double begin_s = run.time.seconds();
  auto judged = model->solve();
  model->judge(judged);
  while (true) {
    record(*model, judged, run.index, run.time.seconds() - begin_s, search);
    compare_with_tolerance(judged, search);
    run.clock->note(text_of_step(judged.scene.name, search));
    search.ended = model->reason_to_end(search, governing_stress(judged));
    if (!search.ended.empty() && model->judge_rest(judged)) {
      compare_with_tolerance(judged, search);
      search.ended = model->reason_to_end(search, governing_stress(judged));
    }
    if (!search.ended.empty()) break;
    begin_s = run.time.seconds();
    auto finer = next(model, judged, run, search);
    if (!finer) break;
    judged = std::move(*finer);
  }
  if (model->judge_rest(judged)) compare_with_tolerance(judged, search);
  judged.search = std::move(search);
  return judged;
}

}  // namespace pipelines
