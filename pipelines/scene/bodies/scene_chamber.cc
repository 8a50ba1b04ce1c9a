#include "pipelines/scene/bodies/scene_body.h"

namespace pipelines {
namespace {

constexpr double longest_chamber_m = 10;

meshes::ChamberMeshControl read_mesh(SceneTable mesh) {
  using Control = meshes::ChamberMeshControl;
  const Control usual;
  Control control;
  control.cells_through_wall =
      mesh.count_or("cells_through_wall", 1, Control::most_cells_through_wall, usual.cells_through_wall,
                    "quadratic cells through the tube's wall");
  control.size_m = mesh.quantity_if_given("size", "m", positive(longest_chamber_m)).value_or(control.size_m);
  control.growth = mesh.quantity_or("growth", "1", between(0.05, Control::steepest_growth), usual.growth,
                                    "slope of the cell size away from weld toes");
  control.min_scaled_jacobian = mesh.quantity_or("min_scaled_jacobian", "1", between(0.01, 0.99),
                                                 usual.min_scaled_jacobian, "worse meshes are refused");
  mesh.finish();
  return control;
}

}  // namespace

ChamberShape read_chamber_shape(SceneTable& body, const kinetics::VibratoryMill& mill,
                                const std::optional<MillingSpace>& space) {
  const Range length = positive(longest_chamber_m);
  ChamberShape shape;
  auto& g = shape.geometry;
  SceneTable tube = body.table("tube");
  if (space) {
    g.tube.inner_radius_m =
        tube.quantity_or("inner_radius", "m", length, space->inner_radius_m, "that of machine.chamber");
    g.tube.length_m =
        tube.quantity_or("length", "m", length, space->inner_length_m, "that of machine.chamber");
  } else {
    g.tube.inner_radius_m = tube.quantity("inner_radius", "m", length);
    g.tube.length_m = tube.quantity("length", "m", length);
  }
  g.tube.wall_m = tube.quantity("wall", "m", length);
  g.tube.axis_x_m = mill.chamber_centre_m[0];
  g.tube.axis_y_m = mill.chamber_centre_m[1];
  tube.finish();
  SceneTable flanges = body.table("flanges");
  g.flanges.outer_radius_m = flanges.quantity("outer_radius", "m", length);
  g.flanges.thickness_m = flanges.quantity("thickness", "m", length);
  flanges.finish();
  SceneTable housing = body.table("housing");
  g.housing.outer_radius_m = housing.quantity("outer_radius", "m", length);
  g.housing.bore_radius_m = housing.quantity("bore_radius", "m", length);
  g.housing.length_m = housing.quantity("length", "m", length);
  housing.finish();
  SceneTable webs = body.table("webs");
  g.webs.thickness_m = webs.quantity("thickness", "m", length);
  g.webs.height_m = webs.quantity("height", "m", length);
  g.webs.z_m = webs.list("places", "m", between(-longest_chamber_m, longest_chamber_m));
  webs.finish();
  SceneTable feet = body.table("feet");
  g.lugs.thickness_m = feet.quantity("lug_thickness", "m", length);
  g.lugs.width_m = feet.quantity("lug_width", "m", length);
  g.lugs.z_m = feet.quantity("place", "m", length);
  const auto pad = feet.quantities("pad", "m", length, 3);
  if (pad.size() == 3) g.pads = {pad[0], pad[1], pad[2]};
  feet.finish();
  for (const auto& spring : mill.springs) g.feet.push_back({spring.position_m[0], spring.position_m[1]});
  shape.mesh = read_mesh(body.table_or_empty("mesh"));
  return shape;
}

}  // namespace pipelines
