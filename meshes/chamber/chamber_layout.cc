#include "meshes/chamber/chamber_layout.h"

#include <algorithm>
#include <cmath>

#include "meshes/chamber/pad_contact.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

const double largest_share_of_housing = 0.8;  // half the web's height there, of the housing's radius
const double chosen_size_share = 0.15;        // default cell size, as a share of the tube's outer radius
const double closest_walls = 0.05;
const double fine_reach_walls = 1.5, fine_share_of_distance = 0.1;

WebLayout lay_out_webs(const Chamber& chamber, double tube_outer_m) {
  const double to_tube_rad = std::atan2(chamber.tube.axis_y_m, chamber.tube.axis_x_m);
  const double to_housing_rad = std::atan2(-chamber.tube.axis_y_m, -chamber.tube.axis_x_m);
  const double half_m = 0.5 * chamber.webs.height_m, housing_m = chamber.housing.outer_radius_m;
  const double half_rad = std::asin(half_m / tube_outer_m);
  const double at_housing_m = std::min(half_m, largest_share_of_housing * housing_m);
  const double housing_half_rad = std::asin(at_housing_m / housing_m);
  return {to_housing_rad - half_rad, to_housing_rad + half_rad, to_tube_rad + housing_half_rad,
          to_tube_rad - housing_half_rad};
}

FootLayout lay_out_foot(const Chamber& chamber, std::size_t index, double tube_outer_m) {
  const ChamberFoot& foot = chamber.feet[index];
  const double dx = foot.x_m - chamber.tube.axis_x_m, dy = foot.y_m - chamber.tube.axis_y_m;
  const double half_m = 0.5 * chamber.lugs.width_m;
  const double half_rad = std::asin(half_m / tube_outer_m);
  FootLayout layout;
  layout.direction_rad = std::atan2(dy, dx);
  layout.first_rad = layout.direction_rad - half_rad;
  layout.last_rad = layout.direction_rad + half_rad;
  layout.contact = pad_contact(chamber, foot, layout.direction_rad);
  layout.sole_sign = dy > 0 ? 1 : -1;
  return layout;
}

std::vector<Plate> plates_of(const Chamber& chamber, const ChamberLayout& layout) {
  std::vector<Plate> plates;
  const double half_web_m = 0.5 * chamber.webs.thickness_m, half_lug_m = 0.5 * chamber.lugs.thickness_m;
  for (std::size_t i = 0; i < chamber.webs.z_m.size(); ++i)
    plates.push_back({"web " + std::to_string(i + 1), layout.web.first_rad, layout.web.last_rad,
                      chamber.webs.z_m[i] - half_web_m, chamber.webs.z_m[i] + half_web_m});
  const double z_m = chamber.lugs.z_m;
  for (std::size_t i = 0; i < layout.feet.size(); ++i) {
    const FootLayout& foot = layout.feet[i];
    const std::string name = "lug " + std::to_string(i + 1);
    plates.push_back({name + " front", foot.first_rad, foot.last_rad, z_m - half_lug_m, z_m + half_lug_m});
    plates.push_back({name + " back", foot.first_rad, foot.last_rad, -z_m - half_lug_m, -z_m + half_lug_m});
  }
  return plates;
}

}  // namespace

ChamberLayout lay_out(const Chamber& chamber, const ChamberMeshControl& control) {
  ChamberLayout layout;
  layout.tube_outer_m = chamber.tube.inner_radius_m + chamber.tube.wall_m;
  const double wanted_m = control.size_m > 0 ? control.size_m : chosen_size_share * layout.tube_outer_m;
  layout.size_m = std::min(wanted_m, coarsest_turn_rad * layout.tube_outer_m);
  layout.toe_size_m = std::min(control.toe_walls * chamber.tube.wall_m, layout.size_m);
  layout.closest_m = closest_walls * chamber.tube.wall_m;
  layout.flange_begin_m = 0.5 * chamber.tube.length_m - chamber.flanges.thickness_m;
  layout.web = lay_out_webs(chamber, layout.tube_outer_m);
  for (std::size_t i = 0; i < chamber.feet.size(); ++i)
    layout.feet.push_back(lay_out_foot(chamber, i, layout.tube_outer_m));
  layout.plates = plates_of(chamber, layout);
  layout.fine_reach_m = fine_reach_walls * chamber.tube.wall_m;
  for (const FineToe& toe : control.fine_toes) {
    const double angle_rad =
        std::atan2(toe.at_m[1] - chamber.tube.axis_y_m, toe.at_m[0] - chamber.tube.axis_x_m);
    layout.fine_places.push_back({angle_rad * layout.tube_outer_m, toe.at_m[2],
                                  std::min(toe.walls * chamber.tube.wall_m, layout.toe_size_m)});
  }
  return layout;
}

double ChamberLayout::toe_size_at_distance(const FinePlace& place, double distance_m) const {
  if (distance_m > fine_reach_m) return toe_size_m;
  return std::min(toe_size_m, std::max(place.size_m, fine_share_of_distance * distance_m));
}

double ChamberLayout::toe_size_at_z(double z_m) const {
  double smallest_m = toe_size_m;
  for (const FinePlace& place : fine_places)
    smallest_m = std::min(smallest_m, toe_size_at_distance(place, std::abs(place.z_m - z_m)));
  return smallest_m;
}

double ChamberLayout::toe_size_within(double first_rad, double last_rad) const {
  double smallest_m = toe_size_m;
  for (const FinePlace& place : fine_places) {
    const double from_middle_rad =
        std::remainder(place.arc_m / tube_outer_m - 0.5 * (first_rad + last_rad), 2 * pi);
    const double beyond_rad = std::max(0.0, std::abs(from_middle_rad) - 0.5 * (last_rad - first_rad));
    smallest_m = std::min(smallest_m, toe_size_at_distance(place, beyond_rad * tube_outer_m));
  }
  return smallest_m;
}

double ChamberLayout::finest_toe_m() const {
  double smallest_m = toe_size_m;
  for (const FinePlace& place : fine_places) smallest_m = std::min(smallest_m, place.size_m);
  return smallest_m;
}

PlanePoint on_circle(double centre_x_m, double centre_y_m, double radius_m, double angle_rad) {
  return {centre_x_m + radius_m * std::cos(angle_rad), centre_y_m + radius_m * std::sin(angle_rad)};
}

PlanePoint on_tube(const Chamber& chamber, const ChamberLayout& layout, double angle_rad) {
  return on_circle(chamber.tube.axis_x_m, chamber.tube.axis_y_m, layout.tube_outer_m, angle_rad);
}

}  // namespace meshes
