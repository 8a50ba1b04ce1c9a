#include "pipelines/search/first_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "pipelines/common/refusal_of.h"
#include "pipelines/refinement/refinement.h"
#include "pipelines/refinement/solid_refinement.h"

namespace pipelines {
namespace {

std::optional<FirstMesh> first_mesh_in_time(const BodyScene& body,
                                            const std::function<MeshedBody(const BodyScene&)>& mesh,
                                            const std::function<double()>& seconds_left) {
  constexpr double share_of_meshing = 0.3, least_meshing_s = 4, much_coarser = 0.8;
  if (std::isinf(seconds_left())) return std::nullopt;
  std::optional<FirstMesh> taken;
  for (const auto& candidate : first_meshes_in_time(body)) {
    const double meshing_s = std::max(least_meshing_s, share_of_meshing * seconds_left());
    std::optional<MeshedBody> meshed;
    if (!refusal_of([&] { meshed = mesh(with_meshing_limit(candidate, meshing_s)); }).empty()) continue;
    const auto n_dofs = double(meshed->model->n_dofs());
    if (taken && n_dofs > much_coarser * double(taken->meshed.model->n_dofs())) break;
    taken = FirstMesh{candidate, std::move(*meshed)};
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
  return {own, mesh(own)};
}

}  // namespace pipelines
