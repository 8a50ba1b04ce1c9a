#include "meshes/chamber/chamber_checks.h"

#include <cmath>
#include <sstream>
#include <string>

#include "meshes/checks/affordable.h"
#include "meshes/values/constants.h"
#include "meshes/values/refusal.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

[[noreturn]] void refuse_chamber(const std::string& what) {
  throw GeometryRefused("chamber: " + what);
}

void require_positive(double value_m, const std::string& what) {
  if (!std::isfinite(value_m) || !(value_m > 0))
    refuse_chamber(what + " = " + mm(value_m) + " must be positive and finite");
}

void require_finite(double value_m, const std::string& what) {
  if (!std::isfinite(value_m)) refuse_chamber(what + " = " + mm(value_m) + " must be finite");
}

/// @param reason what the limits are made of, with the remedy
void require_between(double value_m, double least_m, double most_m, const std::string& what,
                     const std::string& reason) {
  const double rounding_m = 1e-9 * std::abs(most_m);
  if (value_m < least_m - rounding_m || value_m > most_m + rounding_m)
    refuse_chamber(what + " = " + mm(value_m) + " must lie between " + mm(least_m) + " and " + mm(most_m) +
                   ": " + reason);
}

void check_rings(const Chamber& chamber) {
  const ChamberTube& tube = chamber.tube;
  require_positive(tube.inner_radius_m, "the tube's inner radius");
  require_positive(tube.wall_m, "the tube's wall");
  require_positive(tube.length_m, "the tube's length");
  require_finite(tube.axis_x_m, "the tube's axis x");
  require_finite(tube.axis_y_m, "the tube's axis y");
  require_between(tube.wall_m, 0.01 * tube.inner_radius_m, 0.3 * tube.inner_radius_m, "the tube's wall",
                  "1 % to 30 % of its inner radius");
  const double outer_m = tube.inner_radius_m + tube.wall_m;

  const ChamberFlanges& flanges = chamber.flanges;
  require_positive(flanges.outer_radius_m, "the flanges' outer radius");
  require_positive(flanges.thickness_m, "the flanges' thickness");
  require_between(flanges.outer_radius_m, outer_m + tube.wall_m, 2 * outer_m, "the flanges' outer radius",
                  "one wall above the tube's outside to twice its radius");
  require_between(flanges.thickness_m, 0.25 * tube.wall_m, 0.25 * tube.length_m, "the flanges' thickness",
                  "a quarter of the wall to a quarter of the tube's length");

  const ChamberHousing& housing = chamber.housing;
  require_positive(housing.outer_radius_m, "the housing's outer radius");
  require_positive(housing.bore_radius_m, "the housing's bore radius");
  require_positive(housing.length_m, "the housing's length");
  require_between(housing.bore_radius_m, 0.1 * housing.outer_radius_m, 0.95 * housing.outer_radius_m,
                  "the housing's bore radius", "10 % to 95 % of its outer radius");
}

void check_webs(const Chamber& chamber) {
  const ChamberWebs& webs = chamber.webs;
  const double wall_m = chamber.tube.wall_m, outer_m = chamber.tube.inner_radius_m + wall_m;
  if (webs.z_m.empty() || webs.z_m.size() > 8)
    refuse_chamber("there are " + std::to_string(webs.z_m.size()) + " webs; give 1 to 8");
  require_positive(webs.thickness_m, "the webs' thickness");
  require_positive(webs.height_m, "the webs' height");
  require_between(webs.thickness_m, 0.5 * wall_m, 0.5 * chamber.housing.length_m, "the webs' thickness",
                  "half the tube's wall to half the housing's length");
  require_between(webs.height_m, 3 * wall_m, 1.2 * outer_m, "the webs' height",
                  "3 walls of the tube to 1.2 of its outer radius");
  const double room_m = 0.5 * (chamber.housing.length_m - webs.thickness_m);
  for (const double z_m : webs.z_m) {
    require_finite(z_m, "a web's z");
    require_between(z_m, -room_m, room_m, "a web's z",
                    "its thickness must meet the housing, " + mm(chamber.housing.length_m) +
                        " long; make the housing longer or move the web");
    require_between(std::abs(z_m), 0, 0.5 * (chamber.tube.length_m - webs.thickness_m),
                    "a web's distance from the middle",
                    "its thickness must meet the tube, " + mm(chamber.tube.length_m) + " long");
  }
}

void check_feet(const Chamber& chamber) {
  const ChamberLugs& lugs = chamber.lugs;
  const ChamberPads& pads = chamber.pads;
  const double wall_m = chamber.tube.wall_m, outer_m = chamber.tube.inner_radius_m + wall_m;
  if (chamber.feet.empty() || chamber.feet.size() > 4)
    refuse_chamber("there are " + std::to_string(chamber.feet.size()) + " feet; give 1 to 4");
  for (std::size_t i = 0; i < chamber.feet.size(); ++i) {
    require_finite(chamber.feet[i].x_m, "x of foot " + std::to_string(i + 1));
    require_finite(chamber.feet[i].y_m, "y of foot " + std::to_string(i + 1));
  }
  require_positive(lugs.thickness_m, "the lugs' thickness");
  require_positive(lugs.width_m, "the lugs' width");
  require_positive(lugs.z_m, "the lugs' z");
  require_between(lugs.z_m, 0, 0.5 * (chamber.tube.length_m - lugs.thickness_m), "the lugs' z",
                  "their thickness must meet the tube, " + mm(chamber.tube.length_m) + " long");
  require_positive(pads.size_x_m, "the pads' size in x");
  require_positive(pads.size_y_m, "the pads' size in y");
  require_positive(pads.size_z_m, "the pads' size in z");
  require_between(lugs.thickness_m, 0.5 * wall_m, pads.size_z_m, "the lugs' thickness",
                  "half the tube's wall to the pads' size in z");
  require_between(lugs.width_m, 3 * wall_m, outer_m, "the lugs' width",
                  "3 walls of the tube to its outer radius");
  require_between(pads.size_z_m, lugs.thickness_m, 2 * lugs.z_m - wall_m, "the pads' size in z",
                  "front and back pads keep one wall apart");
}

}  // namespace

void check_control(const ChamberMeshControl& control) {
  const auto refuse_control = [](const std::string& what) { throw GeometryRefused("mesh control: " + what); };
  if (control.cells_through_wall < 1 ||
      control.cells_through_wall > ChamberMeshControl::most_cells_through_wall)
    refuse_control("cells_through_wall = " + std::to_string(control.cells_through_wall) +
                   " must lie between 1 and " + std::to_string(ChamberMeshControl::most_cells_through_wall));
  if (!(control.toe_walls > 0 && control.toe_walls <= 2))
    refuse_control("toe_walls = " + std::to_string(control.toe_walls) + " must lie between 0 and 2");
  for (const FineToe& toe : control.fine_toes)
    if (!(toe.walls > 0 && toe.walls <= 2))
      refuse_control("walls = " + std::to_string(toe.walls) + " of a fine toe must lie between 0 and 2");
  if (!std::isfinite(control.size_m) || control.size_m < 0)
    refuse_control("size_m = " + std::to_string(control.size_m) + " must be positive, or 0");
  if (!(control.growth > 0 && control.growth <= ChamberMeshControl::steepest_growth))
    refuse_control("growth = " + std::to_string(control.growth) + " must be positive, and at most " +
                   std::to_string(ChamberMeshControl::steepest_growth));
  if (!(control.min_scaled_jacobian > 0 && control.min_scaled_jacobian < 1))
    refuse_control("min_scaled_jacobian = " + std::to_string(control.min_scaled_jacobian) +
                   " must lie between 0 and 1");
}

void check_sizes(const Chamber& chamber) {
  check_rings(chamber);
  check_webs(chamber);
  check_feet(chamber);
}

void check_cells(const Chamber& chamber, const ChamberLayout& layout, const ChamberMeshControl& control) {
  const double n_around = 2 * pi * layout.tube_outer_m / layout.size_m;
  const double n_along = chamber.tube.length_m / layout.size_m;
  require_affordable(n_around * n_along * control.cells_through_wall, bytes_per_hexahedron, "size_m",
                     "make it larger, or leave it out");
}

}  // namespace meshes
