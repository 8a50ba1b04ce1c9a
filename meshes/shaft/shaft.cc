#include "meshes/shaft/shaft.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "meshes/checks/quality.h"
#include "meshes/shaft/meridian.h"
#include "meshes/shaft/revolve.h"
#include "meshes/shaft/shaft_description.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/shaft_layout/shaft_layout.h"
#include "meshes/shaft_layout/shaft_surfaces.h"
#include "meshes/spacing/disc.h"

namespace meshes {

namespace {

GroupNames group_names(const Shaft& shaft, const SurfaceTable& surfaces) {
  GroupNames names;
  const auto is_solid = [](const ShaftSegment& segment) { return segment.bore_m == 0; };
  if (std::any_of(shaft.segments.begin(), shaft.segments.end(), is_solid))
    names.volumes[surfaces.core_id] = "core";
  for (std::size_t i = 0; i < shaft.segments.size(); ++i)
    names.volumes[surfaces.ring_ids[i]] = "ring_" + shaft.segments[i].name;
  for (const Feature& feature : surfaces.features) names.boundaries[feature.boundary_id] = feature.name;
  return names;
}

std::vector<SectionPlane> sections_of(const Shaft& shaft, const ShaftLayout& layout,
                                      const Meridian& meridian) {
  std::vector<SectionPlane> planes;
  for (const MeridianStation& station : meridian.stations) {
    const SegmentLayout& segment = layout.segments[station.segment];
    const double margin_m = std::min(station.z_m - segment.begin_m, segment.end_m - station.z_m);
    const bool plain = margin_m >= segment.radius_m * (1 - 1e-9);
    planes.push_back({station.z_m, segment.radius_m, segment.shift_x_m, segment.shift_y_m,
                      shaft.segments[station.segment].name, plain, segment.bore_radius_m});
  }
  return planes;
}

/// Everything but the cells of the whole body.
struct Blocks {
  ShaftLayout layout;
  SurfaceTable surfaces;
  Meridian meridian;
  Disc disc;
};

Blocks blocks_of(const Shaft& shaft, const ShaftMeshControl& control) {
  check_control(control);
  check_shaft(shaft);
  check_cells(shaft, control);
  const ShaftMeshControl before = before_subdivision(control);
  ShaftLayout layout = lay_out(shaft, before);
  SurfaceTable surfaces = name_surfaces(shaft, layout);
  Meridian meridian = build_meridian(layout, surfaces, before);
  return {std::move(layout), std::move(surfaces), std::move(meridian),
          build_disc(control.n_sectors, control.subdivisions)};
}

BodyMesh description(const Shaft& shaft, const Blocks& blocks) {
  const auto& [layout, surfaces, meridian, disc] = blocks;
  BodyMesh body;
  body.ports = ports_of(shaft, layout, surfaces);
  body.features = surfaces.features;
  body.cylinders = cylinders_of(layout, surfaces);
  body.tori = tori_of(layout, surfaces);
  body.sections = sections_of(shaft, layout, meridian);
  body.sharp_edges = sharp_edges_of(shaft, layout);
  return body;
}

}  // namespace

BodyMesh describe_shaft(const Shaft& shaft, const ShaftMeshControl& control) {
  return description(shaft, blocks_of(shaft, control));
}

BodyMesh build_shaft(const Shaft& shaft, const ShaftMeshControl& control) {
  const Blocks blocks = blocks_of(shaft, control);
  const HexMesh mesh = revolve(blocks.meridian, blocks.layout, blocks.surfaces, blocks.disc);
  BodyMesh body = description(shaft, blocks);
  body.groups = group_names(shaft, blocks.surfaces);
  body.quality = measure_quality(mesh);
  require_quality(body.quality, control.min_scaled_jacobian, "shaft mesh",
                  "change the fillet or the eccentricity there, or lower min_scaled_jacobian");
  body.cells = std::make_shared<const CellMesh>(to_cell_mesh(mesh));
  return body;
}

}  // namespace meshes
