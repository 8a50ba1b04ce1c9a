#include "pipelines/search/models/solid_model.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "fem/base/common/deadline.h"
#include "fem/base/values/cost_constants.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/judge/analysis/load_patch.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/judge/estimates/in_time.h"
#include "pipelines/judge/estimates/submodels.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/search/models/search_mesh.h"
#include "pipelines/search/refinement/second_model.h"
#include "pipelines/search/refinement/singular_edge.h"

namespace pipelines {
namespace {

/// Finer cells lock less, so that stress grows with them where nothing is sharp.
bool is_locking(const GoverningStress& stress) {
  constexpr double locked_share = 0.1;
  return stress.errors.of("locking") > locked_share * stress.value_Pa;
}

}  // namespace

SolidModel::SolidModel(RunOfBody run, Loaded loaded)
    : BodyModel(std::move(run), std::move(loaded)), known_(body()) {}

Judged SolidModel::solve() {
  if (run_.is_search && is_first_) be_guided();
  auto responded = respond(body(), meshed(), body_loads(), run_.options, clock());
  n_dofs_ = responded.responses.n_dofs;
  return judged(std::move(responded), meshed());
}

/// A second model tells a shaft's first mesh where to be fine.
void SolidModel::be_guided() {
  const RunTime time;
  auto model = second_model();
  second_model_s_ = time.seconds();
  if (!model) return;
  Scene guided = scene();
  guided.bodies[run_.index] = guided_by(*model, body());
  known_.history.compare_with(std::move(*model));
  std::optional<MeshedBody> mesh;
  const auto refusal =
      refusal_of([&] { mesh = mesh_in_stage(guided, guided.bodies[run_.index], nullptr, clock()); });
  if (refusal.empty()) loaded_ = loaded_with(guided, std::move(*mesh));
}

/// Where it applies, fits into memory and is found in half of the time that is left: the solid can do
/// without.
std::optional<SecondModel> SolidModel::second_model() {
  if (!run_.has_second_model) return std::nullopt;
  return clock().run("second model", [&] {
    std::optional<SecondModel> model;
    try {
      const auto refusal = refusal_of([&] {
        in_time(run_.seconds_left() / 2, [&] {
          model = axisymmetric_second_model(body(), meshed(), body_loads(), run_.tolerance,
                                            run_.options.n_threads);
        });
      });
      if (!refusal.empty()) model.reset();
    } catch (const std::bad_alloc&) {  // a strict tolerance asks for fine sections
      model.reset();
    }
    return model;
  });
}

void SolidModel::compare_with_second_model() {
  const RunTime time;
  if (auto model = second_model()) known_.history.compare_with(std::move(*model));
  second_model_s_ = time.seconds();
}

void SolidModel::judge(Judged& solved) {
  if (!run_.is_search) return judge_once(solved);
  if (has_other_loads_ && known_.history.second_model()) compare_with_second_model();
  const bool grows = known_.growth.at(solved, step_ ? step_->ratio : 1);
  if (grows && !is_locking(governing_stress(solved))) leave_out_edge_without_bound(solved);
  known_.history.add(places_of_this_mesh(solved, run_.end_s), step_);
  judge_places(solved, may_be_last(known_.history.judged()) ? GoalPlaces::all : GoalPlaces::leading);
}

/// The scene's own mesh, beside which there is no other.
void SolidModel::judge_once(Judged& analysis) {
  known_.history.add(places_of_this_mesh(analysis, 0), std::nullopt);
  take_place_errors(analysis, known_.history.judged(),
                    analysis.responses.nodes.shape().is_tetrahedron()
                        ? submodel_method
                        : "single cells around, times a safety factor of 3");
}

/// A stress that grows with every refinement has no peak to report: its place joins the sharp edges, which
/// are left out by a distance fixed in the geometry, and the search goes on for the rest. The whole edge is
/// left out: else the peak would only move along it. Where there is no edge, nothing is.
void SolidModel::leave_out_edge_without_bound(Judged& analysis) {
  const auto found = edge_without_bound(analysis);
  if (!found) return;
  run_.warn(found->warning);
  loaded_.scene.bodies[run_.index].singular.push_back(found->edge);
  loaded_.meshed[run_.index].mesh.sharp_edges.push_back(found->edge);
  Judged before = std::move(analysis);
  analysis = judged_again(before);
}

/// The submodels that tell the errors of tetrahedra may take longer than the solution.
/// @param end_s  of the submodels; 0: never
std::vector<PlaceStress> SolidModel::places_of_this_mesh(const Judged& analysis, double end_s) {
  const double seconds = n_ranks_of_a_body() > 1 ? std::numeric_limits<double>::infinity()
                                                 : std::max(1e-3, run_.time.seconds_until(end_s));
  return clock().run("errors", [&] { return places_of_one_mesh(analysis, seconds); });
}

/// Whether the changes of the stress alone would meet the tolerance: the search may end.
bool SolidModel::may_be_last(const std::vector<PlaceStress>& places) const {
  if (places.empty()) return false;
  const auto judgement = pipelines::judge(places);
  const auto& leading = places[judgement.governing];
  return leading.error_Pa + judgement.other_places_Pa <= run_.tolerance * leading.value_Pa;
}

/// Enters what the meshes so far, and all cells of this one, tell of the places; keeps what a next step would
/// cut.
void SolidModel::judge_places(Judged& analysis, GoalPlaces places) {
  const auto& second = known_.history.second_model();
  auto judged = known_.history.judged();
  if (is_refined_locally(analysis.scene)) {
    const bool others_are_known = second && second->model_error == 0;
    is_rest_judged_ = places == GoalPlaces::all || others_are_known;
    local_ = clock().run("refine", [&] {
      return cells_to_cut(*meshed().model, analysis, judged, others_are_known ? GoalPlaces::leading : places,
                          run_.tolerance);
    });
    judged = with_goal_errors(std::move(judged), local_);
  }
  take_place_errors(analysis, judged,
                    second ? "changes of the stress with the mesh, and harmonics around the axis beside it"
                           : "changes of the stress with the mesh, or cells around");
  if (analysis.diagrams && second) analysis.diagrams->by_harmonics = second->torsion;
}

bool SolidModel::judge_rest(Judged& judged) {
  if (is_rest_judged_) return false;
  judge_places(judged, GoalPlaces::all);
  return true;
}

std::string SolidModel::reason_to_end(const Search& search, const GoverningStress& stress) const {
  return pipelines::reason_to_end(search, stress, is_block_shaft(body()));
}

Finer SolidModel::finer(const Judged& judged, const Search& search) {
  const double seconds_before = search.steps.back().seconds - std::exchange(second_model_s_, 0.0);
  Scene next = scene();
  next.bodies[run_.index].felt_seats.merge(felt_seats(judged));
  const auto other =
      refine_sampling_and_harmonics(next, run_.index, governing_stress(judged), judged.loads.history);
  if (other.possible && !other.mesh_matters) return with_better_loads(next, seconds_before);
  return with_finer_mesh(next, judged, seconds_before);
}

Finer SolidModel::with_better_loads(const Scene& next, double seconds_before) const {
  auto better = std::make_unique<SolidModel>(*this);
  better->step_.reset();
  better->loaded_ = loaded_with(next, MeshedBody(meshed()));
  return forecast(std::move(better), seconds_before);
}

/// The part of the mesh that promises most of those that the mesher makes finer.
Finer SolidModel::with_finer_mesh(const Scene& next, const Judged& judged, double seconds_before) {
  const auto i = run_.index;
  const auto& places = judged.place_stresses;
  const auto& target = places[pipelines::judge(places).holding_back].feature;
  // A finer mesh would not be solved in less than this one.
  const auto seconds_to_mesh = [&] { return run_.seconds_left() - seconds_before; };
  std::string refusal;
  for (const auto part : known_.history.by_promise(target)) {
    if (known_.exhausted.count(part)) continue;
    Scene finer = next;
    const bool is_local = part == MeshPart::local;
    auto step = is_local ? refine_locally(finer.bodies[i], local_)
                         : refine_mesh(finer.bodies[i], judged, places, part);
    if (!step) continue;
    const auto make = [&](BodyScene& candidate) {
      return mesh_refined(candidate, [&] {
        return mesh_in_stage(finer, candidate, is_local ? &meshed() : nullptr, clock());
      });
    };
    std::optional<SearchMesh> found;
    if (seconds_to_mesh() >= 0)
      in_time(run_.seconds_left(),
              [&] { found = finer_mesh(finer.bodies[i], make, seconds_to_mesh, refusal); });
    if (!found && !(seconds_to_mesh() >= 0)) return {nullptr, time_is_up, seconds_before};  // at least
    if (!found) {
      known_.exhausted.insert(part);
      continue;
    }
    finer.bodies[i] = std::move(found->body);
    auto model = std::make_unique<SolidModel>(*this);
    model->step_ = std::move(step);
    model->loaded_ = loaded_with(finer, std::move(found->meshed));
    return forecast(std::move(model), seconds_before);
  }
  return {nullptr, "the mesh cannot be refined further" + (refusal.empty() ? "" : ": " + refusal)};
}

/// By the seconds that this mesh took.
Finer SolidModel::forecast(std::unique_ptr<SolidModel> finer, double seconds_before) const {
  finer->is_first_ = false;
  finer->second_model_s_ = 0;
  finer->has_other_loads_ = scene().sampling.instants_per_turn != finer->scene().sampling.instants_per_turn ||
                            body().pressure_harmonics != finer->body().pressure_harmonics;
  const double growth = double(finer->meshed().model->n_dofs()) / double(n_dofs_);
  return {std::move(finer), "", seconds_before * std::pow(growth, growth_of_seconds)};
}

void SolidModel::release() const {
  meshed().model->release_factor();
}

std::string SolidModel::fineness() const {
  return fineness_text(body());
}

/// What natural frequencies will take, at the present pace of the machine.
double SolidModel::seconds_after() const {
  if (body().natural_frequencies <= 0) return 0;
  return fem::at_present_pace(fem::cost::frequencies_s_per_dof * double(meshed().model->n_dofs()));
}

}  // namespace pipelines
