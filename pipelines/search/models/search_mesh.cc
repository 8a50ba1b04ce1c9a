#include "pipelines/search/models/search_mesh.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "meshes/imported/apart.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/search/refinement/refinement.h"
#include "pipelines/search/refinement/solid_refinement.h"

namespace pipelines {
namespace {

constexpr double share_of_meshing = 0.3, least_trial_s = 1, much_coarser = 0.8;

/// Ends work done apart after so many seconds; none without a limit.
std::unique_ptr<meshes::DeadlineApart> deadline_in(double seconds) {
  return std::isinf(seconds) ? nullptr : std::make_unique<meshes::DeadlineApart>(seconds);
}

/// Seconds of cores that this process and those that it started, and that have ended, have taken.
double seconds_of_cores() {
  double seconds = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(who, &used);
    for (const auto& time : {used.ru_utime, used.ru_stime})
      seconds += double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  }
  return seconds;
}

std::optional<SearchMesh> mesh_nearly_as_fine(const BodyScene& body,
                                              const std::function<MeshedBody(BodyScene&)>& mesh,
                                              const std::function<double()>& seconds_left) {
  auto meshes = nearly_as_fine(body);
  for (auto& other : meshes) {
    if (!(seconds_left() >= 0)) break;
    std::optional<MeshedBody> meshed;
    if (refusal_of([&] { meshed = mesh(other); }).empty())
      return SearchMesh{std::move(other), std::move(*meshed)};
  }
  return std::nullopt;
}

std::optional<SearchMesh> first_mesh_in_time(const BodyScene& body,
                                             const std::function<MeshedBody(const BodyScene&)>& mesh,
                                             const std::function<double()>& seconds_left) {
  if (std::isinf(seconds_left())) return std::nullopt;
  const auto candidates = first_meshes_in_time(body);
  std::optional<SearchMesh> taken;
  double meshing_s = 0;  // of the mesh that is taken
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const bool is_last = k + 1 == candidates.size();
    const double left_s = seconds_left(), trial_s = share_of_meshing * left_s;
    if (taken && meshing_s >= left_s) break;
    if (!is_last && trial_s < least_trial_s) {
      if (taken) break;
      continue;
    }
    const double cores_s = seconds_of_cores();
    std::optional<MeshedBody> meshed;
    const auto refusal = refusal_of([&] {
      std::optional<meshes::DeadlineApart> deadline;
      if (taken || !is_last) deadline.emplace(taken ? left_s : trial_s);
      meshed = mesh(candidates[k]);
    });
    const double took_s = left_s - seconds_left();
    if (!refusal.empty()) {
      if (!is_last && took_s >= trial_s) k = candidates.size() - 2;  // too slow: the coarsest one is next
      continue;
    }
    const auto n_dofs = double(meshed->model->n_dofs());
    if (taken && n_dofs > much_coarser * double(taken->meshed.model->n_dofs())) break;
    taken = SearchMesh{candidates[k], std::move(*meshed)};
    meshing_s = took_s;
    // What one mesh waited for a core, beside other programs, its solution will wait too.
    const double pace = std::max(1.0, took_s / std::max(least_trial_s, seconds_of_cores() - cores_s));
    if (pace * seconds_of_tetrahedra(n_dofs) <= seconds_left()) break;
  }
  return taken;
}

}  // namespace

MeshedBody mesh_in_stage(const Scene& scene, const BodyScene& body, const MeshedBody* coarse,
                         StageClock& clock) {
  return clock.run("mesh", [&] { return mesh_body(body, springs_of(scene), coarse); });
}

SearchMesh first_mesh(const BodyScene& body, const std::function<MeshedBody(const BodyScene&)>& mesh,
                      const std::function<double()>& seconds_left) {
  if (auto in_time = first_mesh_in_time(body, mesh, seconds_left)) return std::move(*in_time);
  auto candidates = first_meshes(body);
  const BodyScene own = std::move(candidates.back());
  candidates.pop_back();
  for (const auto& candidate : candidates) {
    std::optional<MeshedBody> meshed;
    if (refusal_of([&] { meshed = mesh(candidate); }).empty()) return {candidate, std::move(*meshed)};
  }
  try {
    return {own, mesh(own)};
  } catch (const meshes::MeshRefused&) {
    if (auto other = mesh_nearly_as_fine(own, mesh, seconds_left)) return std::move(*other);
    throw;
  }
}

std::optional<SearchMesh> finer_mesh(const BodyScene& body, const std::function<MeshedBody(BodyScene&)>& mesh,
                                     const std::function<double()>& seconds_left, std::string& refusal) {
  const auto deadline = deadline_in(seconds_left());
  BodyScene own = body;
  std::optional<MeshedBody> meshed;
  const auto refused = refusal_of([&] { meshed = mesh(own); });
  if (refused.empty()) return SearchMesh{std::move(own), std::move(*meshed)};
  refusal = refused;
  return mesh_nearly_as_fine(body, mesh, seconds_left);
}

std::string warning_of_overrun(const BodyScene& body, const Search& search, double end_s, double now_s) {
  constexpr double as_good_as_kept = 1.2;
  const bool is_import = std::holds_alternative<meshes::Import>(body.shape);
  if (!is_import || search.steps.size() != 1 || end_s <= 0 || now_s <= as_good_as_kept * end_s) return "";
  return fmt::format(
      "{}: the first mesh took until {:.2g} s, with a limit of {:.2g} s; no result takes less than a mesh of "
      "{} "
      "unknowns: make its cells larger (mesh.size, mesh.cells_per_circle, mesh.smallest_size), or leave "
      "small "
      "features out",
      body.name, now_s, end_s, search.steps.front().n_dofs);
}

}  // namespace pipelines
