#include "pipelines/search/loop/search_judgement.h"

#include <utility>

#include "pipelines/judge/stages/place_errors.h"

namespace pipelines {
namespace {

/// Whether the changes of the stress alone would meet the tolerance.
bool may_be_last(const SearchState& state, const std::vector<PlaceStress>& places) {
  if (places.empty()) return false;
  const auto judgement = judge(places);
  const auto& leading = places[judgement.governing];
  return leading.error_Pa + judgement.other_places_Pa <= state.search.tolerance * leading.value_Pa;
}

void judge_with_goals(const MeshedBody& meshed, GoalPlaces places, SearchState& state, BodyAnalysis& analysis,
                      StageClock& clock) {
  const auto& second = state.history.second_model();
  auto judged = state.history.judged();
  if (is_refined_locally(analysis.scene)) {
    const bool others_are_known = second && second->model_error == 0;
    state.others_are_judged = places == GoalPlaces::all || others_are_known;
    state.local = clock.run("refine", [&] {
      return cells_to_cut(*meshed.model, analysis, judged, others_are_known ? GoalPlaces::leading : places,
                          state.search.tolerance);
    });
    judged = with_goal_errors(std::move(judged), state.local);
  }
  take_place_errors(analysis, judged,
                    second ? "changes of the stress with the mesh, and harmonics around the axis beside it"
                           : "changes of the stress with the mesh, or cells around");
  if (analysis.diagrams && second) analysis.diagrams->by_harmonics = second->torsion;
}

}  // namespace

bool is_met(const Search& search, const GoverningStress& stress) {
  return search.tolerance == 0 || stress.relative_error() <= search.tolerance;
}

void judge_places(const MeshedBody& meshed, SearchState& state, BodyAnalysis& analysis, StageClock& clock) {
  const bool is_last = may_be_last(state, state.history.judged());
  judge_with_goals(meshed, is_last ? GoalPlaces::all : GoalPlaces::leading, state, analysis, clock);
}

void judge_other_places(const MeshedBody& meshed, SearchState& state, BodyAnalysis& analysis,
                        StageClock& clock) {
  if (state.others_are_judged) return;
  judge_with_goals(meshed, GoalPlaces::all, state, analysis, clock);
  const auto stress = governing_stress(analysis);
  state.search.steps.back().errors = stress.errors;
  state.search.met = is_met(state.search, stress);
}

}  // namespace pipelines
