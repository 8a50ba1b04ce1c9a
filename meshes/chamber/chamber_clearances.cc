#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "meshes/chamber/chamber_checks.h"
#include "meshes/spacing/convex_polygon.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

/// A part as a convex polygon (or a point, for discs) grown by a radius, over ranges of z.
struct Part {
  std::string name;
  std::vector<PlanePoint> corners;
  double radius_m = 0;
  std::vector<std::array<double, 2>> ranges_m;
};

using PartPair = std::pair<std::string, std::string>;

std::vector<Part> parts_of(const Chamber& chamber, const ChamberLayout& layout) {
  const PlanePoint axis = {chamber.tube.axis_x_m, chamber.tube.axis_y_m};
  const double end_m = 0.5 * chamber.tube.length_m, housing_m = 0.5 * chamber.housing.length_m;
  std::vector<Part> parts = {
      {"the tube", {axis}, layout.tube_outer_m, {{-end_m, end_m}}},
      {"the flanges",
       {axis},
       chamber.flanges.outer_radius_m,
       {{-end_m, -layout.flange_begin_m}, {layout.flange_begin_m, end_m}}},
      {"the housing", {{0, 0}}, chamber.housing.outer_radius_m, {{-housing_m, housing_m}}}};

  const WebLayout& web = layout.web;
  const auto at_housing = [&](double angle_rad) {
    return on_circle(0, 0, chamber.housing.outer_radius_m, angle_rad);
  };
  for (std::size_t i = 0; i < chamber.webs.z_m.size(); ++i)
    parts.push_back({layout.plates[i].name,
                     {on_tube(chamber, layout, web.first_rad), on_tube(chamber, layout, web.last_rad),
                      at_housing(web.housing_last_rad), at_housing(web.housing_first_rad)},
                     0,
                     {{layout.plates[i].begin_m, layout.plates[i].end_m}}});

  const auto front_and_back = [&](double half_m) {
    const double z_m = chamber.lugs.z_m;
    return std::vector<std::array<double, 2>>{{-z_m - half_m, -z_m + half_m}, {z_m - half_m, z_m + half_m}};
  };
  const double half_x_m = 0.5 * chamber.pads.size_x_m, half_y_m = 0.5 * chamber.pads.size_y_m;
  for (std::size_t i = 0; i < layout.feet.size(); ++i) {
    const FootLayout& foot = layout.feet[i];
    const double x_m = chamber.feet[i].x_m, y_m = chamber.feet[i].y_m;
    const std::string number = std::to_string(i + 1);
    Part lug = {"lug " + number, foot.contact.points, 0, front_and_back(0.5 * chamber.lugs.thickness_m)};
    lug.corners.push_back(on_tube(chamber, layout, foot.last_rad));
    lug.corners.push_back(on_tube(chamber, layout, foot.first_rad));
    parts.push_back(lug);
    parts.push_back({"pad " + number,
                     {{x_m - half_x_m, y_m - half_y_m},
                      {x_m + half_x_m, y_m - half_y_m},
                      {x_m + half_x_m, y_m + half_y_m},
                      {x_m - half_x_m, y_m + half_y_m}},
                     0,
                     front_and_back(0.5 * chamber.pads.size_z_m)});
  }
  return parts;
}

/// Parts that are welded together; pairs in the order of parts_of.
std::vector<PartPair> joined_parts(const Chamber& chamber) {
  std::vector<PartPair> joined = {{"the tube", "the flanges"}};
  for (std::size_t i = 1; i <= chamber.webs.z_m.size(); ++i)
    for (const char* part : {"the tube", "the housing"}) joined.push_back({part, "web " + std::to_string(i)});
  for (std::size_t i = 1; i <= chamber.feet.size(); ++i) {
    joined.push_back({"the tube", "lug " + std::to_string(i)});
    joined.push_back({"lug " + std::to_string(i), "pad " + std::to_string(i)});
  }
  return joined;
}

double distance_in_z(const Part& a, const Part& b) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& p : a.ranges_m)
    for (const auto& q : b.ranges_m) least_m = std::min(least_m, std::max(q[0] - p[1], p[0] - q[1]));
  return least_m;
}

/// @param shift_m  shift of an edge across its plate, over its length `run_m`
void check_taper(const std::string& edge, double shift_m, double run_m, const std::string& remedy) {
  const double steepest = 0.5;
  if (shift_m <= steepest * run_m) return;
  std::ostringstream text;
  text << "chamber: " << edge << " shifts by " << shift_m * 1e3 << " mm over its length of " << run_m * 1e3
       << " mm; 1 in 2 is the most: " << remedy;
  throw GeometryRefused(text.str());
}

void check_tapers(const Chamber& chamber, const ChamberLayout& layout) {
  const WebLayout& web = layout.web;
  const double housing_m = chamber.housing.outer_radius_m;
  const double half_rad = 0.5 * (web.last_rad - web.first_rad);
  const double housing_half_rad = 0.5 * (web.housing_first_rad - web.housing_last_rad);
  check_taper("the edge of the webs",
              layout.tube_outer_m * std::sin(half_rad) - housing_m * std::sin(housing_half_rad),
              std::hypot(chamber.tube.axis_x_m, chamber.tube.axis_y_m) -
                  layout.tube_outer_m * std::cos(half_rad) - housing_m * std::cos(housing_half_rad),
              "make the webs lower, the housing larger, or move the tube away from it");
  for (std::size_t i = 0; i < layout.feet.size(); ++i) {
    const FootLayout& foot = layout.feet[i];
    const double half_m = 0.5 * chamber.lugs.width_m;
    for (const bool last : {false, true}) {
      const PlanePoint begin = on_tube(chamber, layout, last ? foot.last_rad : foot.first_rad);
      const PlanePoint end = last ? foot.contact.points.back() : foot.contact.points.front();
      const double offset_m = last ? foot.contact.offsets_m.back() : foot.contact.offsets_m.front();
      check_taper("an edge of lug " + std::to_string(i + 1), std::abs(offset_m - (last ? half_m : -half_m)),
                  (end[0] - begin[0]) * std::cos(foot.direction_rad) +
                      (end[1] - begin[1]) * std::sin(foot.direction_rad),
                  "move the foot away from the tube, or bring the lug's width nearer to the pad's size");
    }
  }
}

}  // namespace

void check_clearances(const Chamber& chamber, const ChamberLayout& layout) {
  const std::vector<Part> parts = parts_of(chamber, layout);
  const std::vector<PartPair> joined = joined_parts(chamber);
  const double least_m = chamber.tube.wall_m;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (std::find(joined.begin(), joined.end(), PartPair(parts[i].name, parts[j].name)) != joined.end())
        continue;
      const double in_z_m = distance_in_z(parts[i], parts[j]);
      const double in_plane_m =
          convex_distance(parts[i].corners, parts[j].corners) - parts[i].radius_m - parts[j].radius_m;
      if (std::max(in_z_m, in_plane_m) >= least_m * (1 - 1e-9)) continue;
      std::ostringstream text;
      text << "chamber: " << parts[i].name << " and " << parts[j].name << " are "
           << std::max(in_plane_m, 0.0) * 1e3 << " mm apart in the cross-section and "
           << std::max(in_z_m, 0.0) * 1e3 << " mm in z; one of the two must be at least " << least_m * 1e3
           << " mm, the tube's wall: move them apart or make them smaller";
      throw GeometryRefused(text.str());
    }
  check_tapers(chamber, layout);
}

}  // namespace meshes
