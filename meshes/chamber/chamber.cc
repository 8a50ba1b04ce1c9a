#include "meshes/chamber/chamber.h"

#include <cmath>
#include <memory>
#include <utility>

#include "meshes/chamber/chamber_checks.h"
#include "meshes/chamber/chamber_layout.h"
#include "meshes/chamber/chamber_plan.h"
#include "meshes/chamber/chamber_stations.h"
#include "meshes/chamber/chamber_surfaces.h"
#include "meshes/checks/quality.h"
#include "meshes/checks/sharp_edges.h"
#include "meshes/spacing/swept_plan.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

/// All that a chamber's mesh is made of.
struct ChamberBlocks {
  ChamberLayout layout;
  ChamberStations stations;
  ChamberSurfaces surfaces;
  Plan plan;
};

ChamberBlocks chamber_blocks(const Chamber& chamber, const ChamberMeshControl& control) {
  check_control(control);
  check_sizes(chamber);
  ChamberBlocks blocks;
  blocks.layout = lay_out(chamber, control);
  check_cells(chamber, blocks.layout, control);
  check_clearances(chamber, blocks.layout);
  blocks.stations = place_stations(chamber, blocks.layout, control);
  blocks.surfaces = name_surfaces(chamber, blocks.layout);
  blocks.plan = build_plan(chamber, blocks.layout, blocks.stations, blocks.surfaces, control);
  return blocks;
}

BodyMesh tables_of(const Chamber& chamber, const ChamberBlocks& blocks) {
  BodyMesh body;
  body.groups = group_names(blocks.surfaces);
  body.ports = ports_of(chamber, blocks.surfaces);
  body.features = blocks.surfaces.features;
  body.cylinders = cylinders_of(chamber, blocks.layout);
  body.regions = regions_of_chamber();
  body.hot_spots = blocks.stations.hot_spots.hot_spots;
  body.covered_toes = blocks.stations.hot_spots.covered;
  return body;
}

/// A ring about an axis parallel to z, between two pairs of z.
SweptVolume ring_volume(double x_m, double y_m, double inner_m, double outer_m,
                        const std::vector<std::array<double, 2>>& ranges_m) {
  SweptVolume result;
  const double area = pi * (outer_m * outer_m - inner_m * inner_m),
               own = pi / 4 * (std::pow(outer_m, 4) - std::pow(inner_m, 4));
  for (const auto& [p, q] : ranges_m) {
    const double length = q - p, z = (q * q - p * p) / 2, zz = (q * q * q - p * p * p) / 3;
    const double first[3] = {area * x_m * length, area * y_m * length, area * z},
                 second[6] = {(own + area * x_m * x_m) * length,
                              (own + area * y_m * y_m) * length,
                              area * zz,
                              area * x_m * y_m * length,
                              area * y_m * z,
                              area * x_m * z};
    result.volume_m3 += area * length;
    for (std::size_t i = 0; i < 3; ++i) result.first_m4[i] += first[i];
    for (std::size_t i = 0; i < 6; ++i) result.second_m5[i] += second[i];
  }
  return result;
}

}  // namespace

BodyMesh build_chamber(const Chamber& chamber, const ChamberMeshControl& control) {
  const ChamberBlocks blocks = chamber_blocks(chamber, control);
  const HexMesh mesh = sweep(blocks.plan, blocks.stations.z_m);
  BodyMesh body = tables_of(chamber, blocks);
  body.sharp_edges = find_sharp_edges(mesh, blocks.surfaces.plates);
  body.quality = measure_quality(mesh);
  require_quality(body.quality, control.min_scaled_jacobian, "chamber mesh",
                  "change the plate that lies there (lower webs, lugs as wide as their pads, feet further "
                  "away), or lower min_scaled_jacobian");
  body.cells = std::make_shared<const CellMesh>(to_cell_mesh(mesh));
  return body;
}

ChamberDescription describe_chamber(const Chamber& chamber, const ChamberMeshControl& control) {
  const ChamberBlocks blocks = chamber_blocks(chamber, control);
  ChamberDescription result{tables_of(chamber, blocks), swept_volumes(blocks.plan, blocks.stations.z_m), 0};
  for (const auto& entry : result.volumes) result.n_cells += entry.second.n_cells;
  const auto& tube = chamber.tube;
  const auto& housing = chamber.housing;
  const double end_m = tube.length_m / 2, flange_m = blocks.layout.flange_begin_m,
               outer_m = blocks.layout.tube_outer_m, housing_m = housing.length_m / 2;
  result.volumes[tube_volume] =
      ring_volume(tube.axis_x_m, tube.axis_y_m, tube.inner_radius_m, outer_m, {{-end_m, end_m}});
  result.volumes[flanges_volume] =
      ring_volume(tube.axis_x_m, tube.axis_y_m, outer_m, chamber.flanges.outer_radius_m,
                  {{-end_m, -flange_m}, {flange_m, end_m}});
  result.volumes[housing_volume] =
      ring_volume(0, 0, housing.bore_radius_m, housing.outer_radius_m, {{-housing_m, housing_m}});
  return result;
}

}  // namespace meshes
