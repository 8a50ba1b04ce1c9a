#include <cmath>

#include "tests/unit/meshes/examples/chamber_solids.h"

namespace {

double length(const Corners& corners) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    sum += std::hypot(corners[i + 1][0] - corners[i][0], corners[i + 1][1] - corners[i][1]);
  return sum;
}

double perimeter(Corners corners) {
  corners.push_back(corners.front());
  return length(corners);
}

double area(const Corners& corners) {
  return polygon_sums(corners)[0];
}

}  // namespace

std::map<std::string, double> feature_areas(const meshes::Chamber& chamber, const CircleAngles& angles) {
  const ChamberOutlines o = outlines_of(chamber, angles);
  const double tube_m = chamber.tube.length_m, flange_m = chamber.flanges.thickness_m;
  const double housing_m = chamber.housing.length_m, web_m = chamber.webs.thickness_m;
  const double lug_m = chamber.lugs.thickness_m;
  const auto n_webs = static_cast<double>(chamber.webs.z_m.size());

  std::map<std::string, double> areas;
  areas["inner_wall"] = perimeter(o.tube_inner) * tube_m;
  areas["tube outside"] =
      perimeter(o.tube_outer) * (tube_m - 2 * flange_m) - n_webs * web_m * length(o.web_tube_arc);
  const double housing_ring = area(o.housing_outer) - area(o.housing_inner);
  const double flange_ring = area(o.flange_outer) - area(o.tube_outer);
  for (const std::string end : {"1", "2"}) {
    areas["tube end " + end] = area(o.tube_outer) - area(o.tube_inner);
    areas["housing end " + end] = housing_ring;
    areas["flange " + end] = flange_ring + perimeter(o.flange_outer) * flange_m;
  }
  areas["covers"] = 2 * flange_ring;
  areas["housing_bore"] = perimeter(o.housing_inner) * housing_m;
  areas["housing outside"] =
      perimeter(o.housing_outer) * housing_m - n_webs * web_m * length(o.web_housing_arc);
  for (std::size_t i = 0; i < chamber.webs.z_m.size(); ++i)
    areas["web " + std::to_string(i + 1)] =
        2 * area(o.web) + web_m * (perimeter(o.web) - length(o.web_tube_arc) - length(o.web_housing_arc));
  for (std::size_t i = 0; i < chamber.feet.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    const double contact_m = length(o.lug_ends[i]), footprint_m = length(o.lug_tube_arcs[i]);
    const double sole = 2 * chamber.pads.size_x_m * chamber.pads.size_z_m;
    areas["tube outside"] -= 2 * lug_m * footprint_m;
    areas["lug " + number] =
        2 * (2 * area(o.lugs[i]) + lug_m * (perimeter(o.lugs[i]) - footprint_m - contact_m));
    areas["spring_foot_" + number] = sole;
    areas["pad " + number] =
        4 * area(o.pads[i]) + 2 * (chamber.pads.size_z_m * perimeter(o.pads[i]) - lug_m * contact_m) - sole;
  }
  return areas;
}
