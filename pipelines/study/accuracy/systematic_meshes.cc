#include "pipelines/study/accuracy/systematic_meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "pipelines/judge/estimates/fineness.h"

namespace pipelines {
namespace {

constexpr int scene_level = 4;  // level of shafts and tetrahedra that is about as fine as the scene's mesh
constexpr int scene_level_chamber = 2;  // one mesh coarser than the scene's has one cell through the wall
constexpr double steepest_growth = meshes::ShaftMeshControl::steepest_growth;  // limit for chambers too

/// Multiple of `unit` that comes closest to the scene's count, at least one.
int multiple(int count, int unit) {
  return std::max(1, int(std::lround(double(count) / unit)));
}

void refine_shaft(meshes::ShaftMeshControl& mesh, int level) {
  mesh.subdivisions = level;
  const auto cells = [&](int of_scene) { return 2 * level * multiple(of_scene, 2 * scene_level); };
  mesh.cells_per_fillet_quarter = cells(mesh.cells_per_fillet_quarter);
  for (int& own : mesh.fillet_cells)
    if (own > 0) own = cells(own);
  mesh.n_sectors = 8 * level * multiple(mesh.n_sectors, 8 * scene_level);
  mesh.growth = std::min(steepest_growth, mesh.growth * scene_level) / level;
  mesh.largest_cell_m *= double(scene_level) / level;
}

}  // namespace

BodyScene systematic_mesh(const BodyScene& body, int level) {
  if (const auto* chamber = std::get_if<ChamberShape>(&body.shape)) {
    BodyScene even = body;
    auto& mesh = std::get<ChamberShape>(even.shape).mesh;
    mesh.cells_through_wall = 2 * multiple(chamber->mesh.cells_through_wall, 2);
    mesh.growth = std::min(mesh.growth, steepest_growth * systematic_levels[0] / scene_level_chamber);
    return with_fineness(even, double(level) / scene_level_chamber);
  }
  BodyScene result = body;
  if (auto* shaft = std::get_if<ShaftShape>(&result.shape); shaft != nullptr && shaft->keyways.empty()) {
    refine_shaft(shaft->mesh, level);
    return result;
  }
  return with_fineness(body, double(level) / scene_level);
}

double cell_size_m(const fem::Nodes& nodes) {
  if (nodes.n_cells() == 0) throw std::invalid_argument("nodes without cells have no cell size");
  const double volume_m3 = std::accumulate(nodes.volume_m3.begin(), nodes.volume_m3.end(), 0.0);
  return std::cbrt(volume_m3 / double(nodes.n_cells()));
}

}  // namespace pipelines
