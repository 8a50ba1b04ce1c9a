#include "meshes/chamber/chamber.h"

#include <memory>

#include "meshes/chamber/chamber_checks.h"
#include "meshes/chamber/chamber_layout.h"
#include "meshes/chamber/chamber_plan.h"
#include "meshes/chamber/chamber_stations.h"
#include "meshes/chamber/chamber_surfaces.h"
#include "meshes/checks/quality.h"
#include "meshes/checks/sharp_edges.h"
#include "meshes/spacing/swept_plan.h"

namespace meshes {

BodyMesh build_chamber(const Chamber& chamber, const ChamberMeshControl& control) {
  check_control(control);
  check_sizes(chamber);
  const ChamberLayout layout = lay_out(chamber, control);
  check_cells(chamber, layout, control);
  check_clearances(chamber, layout);
  const ChamberStations stations = place_stations(chamber, layout, control);
  const ChamberSurfaces surfaces = name_surfaces(chamber, layout);
  const HexMesh mesh = sweep(build_plan(chamber, layout, stations, surfaces, control), stations.z_m);

  BodyMesh body;
  body.groups = group_names(surfaces);
  body.ports = ports_of(chamber, surfaces);
  body.features = surfaces.features;
  body.cylinders = cylinders_of(chamber, layout);
  body.regions = regions_of_chamber();
  body.sharp_edges = find_sharp_edges(mesh, surfaces.plates);
  body.hot_spots = stations.hot_spots.hot_spots;
  body.covered_toes = stations.hot_spots.covered;
  body.quality = measure_quality(mesh);
  require_quality(body.quality, control.min_scaled_jacobian, "chamber mesh",
                  "change the plate that lies there (lower webs, lugs as wide as their pads, feet further "
                  "away), or lower min_scaled_jacobian");
  body.cells = std::make_shared<const CellMesh>(to_cell_mesh(mesh));
  return body;
}

}  // namespace meshes
