#include "tests/benchmarks/promises/reference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pipelines/cheap_rungs.h"
#include "pipelines/fineness.h"
#include "pipelines/place_stress.h"
#include "pipelines/refinement.h"
#include "pipelines/superposition.h"

namespace promises {
namespace {

using namespace pipelines;

Reference on_section(const BodyScene& body, const MeshedBody& meshed, const BodyLoads& loads) {
  const auto model = axisymmetric_responses(body, meshed.mesh, loads.unit_loads).value();
  const auto maximum = envelope(loads.history, model.responses, 2);
  const auto& nodes = model.responses.nodes;
  Reference result;
  for (const auto& place : largest_by_feature(
           nodes, maximum.von_mises.value_Pa, meshed.mesh.features,
           locate_nodes(nodes, meshed.mesh.features, meshed.mesh.ports, meshed.mesh.sharp_edges))) {
    result.places[place.feature] = place.value_Pa;
    if (place.value_Pa <= result.peak_Pa) continue;
    result.peak_Pa = place.value_Pa;
    result.feature = place.feature;
  }
  return result;
}

}  // namespace

Reference axisymmetric_reference(const Scene& scene, double wanted) {
  Scene with_harmonics = scene;
  auto& body = with_harmonics.bodies.front();
  body.pressure_harmonics *= 3;
  const auto file = std::filesystem::temp_directory_path() / "millstress_promises_reference.msh";
  std::get<ShaftShape>(body.shape).mesh.cells_per_fillet_quarter = 8;
  std::get<ShaftShape>(body.shape).mesh.n_sectors = 16;
  StageClock clock;
  const auto loaded = load_bodies(with_harmonics, {mesh_body(body, file, {})}, clock);
  std::filesystem::remove(file);
  const auto& meshed = loaded.meshed.front();
  const auto& loads = loaded.body_loads.front();
  Reference result = on_section(body, meshed, loads);
  for (const double factor : {2.0, 4.0, 8.0}) {
    Reference finer = on_section(with_fineness(body, factor), meshed, loads);
    finer.change = std::abs(finer.peak_Pa / result.peak_Pa - 1);
    result = std::move(finer);
    if (result.change < wanted) break;
  }
  return result;
}

}  // namespace promises
