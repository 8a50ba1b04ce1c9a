#include "meshes/chamber/chamber_surfaces.h"

#include <algorithm>
#include <string>

namespace meshes {

namespace {

using Kind = Feature::Kind;

class Naming {
public:
  explicit Naming(ChamberSurfaces& surfaces) : surfaces_(surfaces) {}

  int add(const std::string& name, Kind kind, double begin_m, double end_m, double thickness_m) {
    const int id = next_id_++;
    surfaces_.features.push_back({name, kind, id, begin_m, end_m});
    surfaces_.plates[id] = {name, thickness_m};
    return id;
  }

private:
  ChamberSurfaces& surfaces_;
  int next_id_ = housing_volume + 1;
};

void name_plates(const Chamber& chamber, const ChamberLayout& layout, Naming& naming,
                 ChamberSurfaces& surfaces) {
  for (std::size_t i = 0; i < chamber.webs.z_m.size(); ++i) {
    const Plate& web = layout.plates[i];
    surfaces.webs.push_back(
        naming.add(web.name, Kind::surface, web.begin_m, web.end_m, chamber.webs.thickness_m));
  }
  const double lug_m = chamber.lugs.z_m + 0.5 * chamber.lugs.thickness_m;
  const double pad_m = chamber.lugs.z_m + 0.5 * chamber.pads.size_z_m;
  const ChamberPads& pads = chamber.pads;
  const double pad_thickness_m = std::min({pads.size_x_m, pads.size_y_m, pads.size_z_m});
  for (std::size_t i = 0; i < chamber.feet.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    surfaces.pads.push_back(naming.add("pad " + number, Kind::surface, -pad_m, pad_m, pad_thickness_m));
    surfaces.soles.push_back(
        naming.add("spring_foot_" + number, Kind::surface, -pad_m, pad_m, pad_thickness_m));
    surfaces.lugs.push_back(
        naming.add("lug " + number, Kind::surface, -lug_m, lug_m, chamber.lugs.thickness_m));
  }
}

}  // namespace

ChamberSurfaces name_surfaces(const Chamber& chamber, const ChamberLayout& layout) {
  ChamberSurfaces surfaces;
  Naming naming(surfaces);
  const double end_m = 0.5 * chamber.tube.length_m, wall_m = chamber.tube.wall_m;
  surfaces.tube_outside =
      naming.add("tube outside", Kind::surface, -layout.flange_begin_m, layout.flange_begin_m, wall_m);
  surfaces.inner_wall = naming.add("inner_wall", Kind::bore, -end_m, end_m, wall_m);
  surfaces.tube_end_1 = naming.add("tube end 1", Kind::end_face, -end_m, -end_m, wall_m);
  surfaces.tube_end_2 = naming.add("tube end 2", Kind::end_face, end_m, end_m, wall_m);

  const double housing_m = 0.5 * chamber.housing.length_m;
  const double ring_m = chamber.housing.outer_radius_m - chamber.housing.bore_radius_m;
  surfaces.housing_outside = naming.add("housing outside", Kind::surface, -housing_m, housing_m, ring_m);
  surfaces.housing_bore = naming.add("housing_bore", Kind::bore, -housing_m, housing_m, ring_m);
  surfaces.housing_end_1 = naming.add("housing end 1", Kind::end_face, -housing_m, -housing_m, ring_m);
  surfaces.housing_end_2 = naming.add("housing end 2", Kind::end_face, housing_m, housing_m, ring_m);

  const double flange_m = chamber.flanges.thickness_m, inner_m = layout.flange_begin_m;
  surfaces.flange_1 = naming.add("flange 1", Kind::surface, -end_m, -inner_m, flange_m);
  surfaces.flange_2 = naming.add("flange 2", Kind::surface, inner_m, end_m, flange_m);
  surfaces.covers = naming.add("covers", Kind::surface, -end_m, end_m, flange_m);
  name_plates(chamber, layout, naming, surfaces);

  const auto make_round = [&](int id, double radius_m, double axis_x_m, double axis_y_m) {
    auto& plate = surfaces.plates.at(id);
    plate = {plate.name, plate.thickness_m, radius_m, axis_x_m, axis_y_m};
  };
  make_round(surfaces.tube_outside, layout.tube_outer_m, chamber.tube.axis_x_m, chamber.tube.axis_y_m);
  make_round(surfaces.inner_wall, chamber.tube.inner_radius_m, chamber.tube.axis_x_m, chamber.tube.axis_y_m);
  make_round(surfaces.housing_outside, chamber.housing.outer_radius_m, 0, 0);
  make_round(surfaces.housing_bore, chamber.housing.bore_radius_m, 0, 0);
  return surfaces;
}

GroupNames group_names(const ChamberSurfaces& surfaces) {
  GroupNames names;
  names.volumes = {{tube_volume, "tube"}, {flanges_volume, "flanges"}, {webs_volume, "webs"},
                   {lugs_volume, "lugs"}, {pads_volume, "pads"},       {housing_volume, "housing"}};
  for (const Feature& feature : surfaces.features) names.boundaries[feature.boundary_id] = feature.name;
  return names;
}

std::vector<Port> ports_of(const Chamber& chamber, const ChamberSurfaces& surfaces) {
  const double housing_m = 0.5 * chamber.housing.length_m, end_m = 0.5 * chamber.tube.length_m;
  const double x_m = chamber.tube.axis_x_m, y_m = chamber.tube.axis_y_m;
  std::vector<Port> ports = {{"housing_bore", Port::Kind::bore, surfaces.housing_bore, -housing_m, housing_m,
                              chamber.housing.bore_radius_m, 0, 0},
                             {"inner_wall", Port::Kind::bore, surfaces.inner_wall, -end_m, end_m,
                              chamber.tube.inner_radius_m, x_m, y_m}};
  const double pad_m = chamber.lugs.z_m + 0.5 * chamber.pads.size_z_m;
  for (std::size_t i = 0; i < chamber.feet.size(); ++i)
    ports.push_back({"spring_foot_" + std::to_string(i + 1), Port::Kind::face, surfaces.soles[i], -pad_m,
                     pad_m, 0, chamber.feet[i].x_m, chamber.feet[i].y_m});
  ports.push_back(
      {"covers", Port::Kind::face, surfaces.covers, -end_m, end_m, chamber.flanges.outer_radius_m, x_m, y_m});
  return ports;
}

std::vector<CylinderChart> cylinders_of(const Chamber& chamber, const ChamberLayout& layout) {
  const ChamberTube& tube = chamber.tube;
  return {{tube_volume, 0, 0, tube.inner_radius_m, layout.tube_outer_m, tube.axis_x_m, tube.axis_y_m},
          {flanges_volume, 0, 0, layout.tube_outer_m, chamber.flanges.outer_radius_m, tube.axis_x_m,
           tube.axis_y_m},
          {housing_volume, 0, 0, chamber.housing.bore_radius_m, chamber.housing.outer_radius_m, 0, 0}};
}

std::vector<Region> regions_of_chamber() {
  return {{"structure", {tube_volume, flanges_volume, webs_volume, lugs_volume, pads_volume}},
          {"exciter", {housing_volume}}};
}

}  // namespace meshes
