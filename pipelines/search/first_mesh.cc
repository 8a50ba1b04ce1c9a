#include "pipelines/search/first_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "meshes/imported/apart.h"
#include "pipelines/common/refusal_of.h"
#include "pipelines/refinement/refinement.h"
#include "pipelines/refinement/solid_refinement.h"

namespace pipelines {
namespace {

constexpr double share_of_meshing = 0.3, least_trial_s = 1, much_coarser = 0.8;

std::optional<FirstMesh> first_mesh_in_time(const BodyScene& body,
                                            const std::function<MeshedBody(const BodyScene&)>& mesh,
                                            const std::function<double()>& seconds_left) {
  if (std::isinf(seconds_left())) return std::nullopt;
  const auto candidates = first_meshes_in_time(body);
  std::optional<FirstMesh> taken;
  double meshing_s = 0;  // of the mesh that is taken
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const bool is_last = k + 1 == candidates.size();
    const double left_s = seconds_left(), trial_s = share_of_meshing * left_s;
    if (taken && meshing_s >= left_s) break;
    if (!is_last && trial_s < least_trial_s) {
      if (taken) break;
      continue;
    }
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
    taken = FirstMesh{candidates[k], std::move(*meshed)};
    meshing_s = took_s;
    if (seconds_of_tetrahedra(n_dofs) <= seconds_left()) break;
  }
  return taken;
}

}  // namespace

FirstMesh first_mesh(const BodyScene& body, const std::function<MeshedBody(const BodyScene&)>& mesh,
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
    for (const auto& other : nearly_as_fine(own)) {
      std::optional<MeshedBody> meshed;
      if (refusal_of([&] { meshed = mesh(other); }).empty()) return {other, std::move(*meshed)};
    }
    throw;
  }
}

}  // namespace pipelines
