#include "tests/unit/meshes/examples/chamber_solids.h"
#include "meshes/values/constants.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using Corner = std::array<double, 2>;

using meshes::pi;

double tube_outer_m(const meshes::Chamber& chamber) {
  return chamber.tube.inner_radius_m + chamber.tube.wall_m;
}

Corner at(double x_m, double y_m, double radius_m, double angle_rad) {
  return {x_m + radius_m * std::cos(angle_rad), y_m + radius_m * std::sin(angle_rad)};
}

/// From first to last, counter-clockwise, with the corners between them.
Corners arc(const std::vector<double>& angles_rad, double x_m, double y_m, double radius_m, double first_rad,
            double last_rad) {
  std::vector<double> between_rad;
  for (const double angle : angles_rad) {
    double from_first = std::fmod(angle - first_rad, 2 * pi);
    if (from_first < 0) from_first += 2 * pi;
    if (from_first > 1e-9 && from_first < last_rad - first_rad - 1e-9) between_rad.push_back(from_first);
  }
  std::sort(between_rad.begin(), between_rad.end());
  Corners corners = {at(x_m, y_m, radius_m, first_rad)};
  for (const double angle : between_rad) corners.push_back(at(x_m, y_m, radius_m, first_rad + angle));
  corners.push_back(at(x_m, y_m, radius_m, last_rad));
  return corners;
}

Corners circle(const std::vector<double>& angles_rad, double x_m, double y_m, double radius_m) {
  Corners corners;
  for (const double angle : angles_rad) corners.push_back(at(x_m, y_m, radius_m, angle));
  return corners;
}

Corners joined(Corners a, const Corners& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Corners reversed(Corners corners) {
  std::reverse(corners.begin(), corners.end());
  return corners;
}

/// The sides of the pad that a lug may end on, each from left to right as the lug's tube sees them, with
/// their offsets across the strip.
struct Side {
  Corner from{}, to{};
  double from_offset_m = 0, to_offset_m = 0;
};

std::vector<Side> seen_sides(const meshes::Chamber& chamber, const meshes::ChamberFoot& foot, double dx,
                             double dy) {
  const double hx = 0.5 * chamber.pads.size_x_m, hy = 0.5 * chamber.pads.size_y_m;
  const Corner corners[4] = {{-hx, -hy}, {hx, -hy}, {hx, hy}, {-hx, hy}};
  const Corner normals[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  std::vector<Side> sides;
  for (int i = 0; i < 4; ++i) {
    if (-(normals[i][0] * dx + normals[i][1] * dy) < 0.55) continue;
    // Counter-clockwise round the pad is from high to low offset on the side that faces the tube.
    const Corner &low = corners[(i + 1) % 4], &high = corners[i];
    sides.push_back({{foot.x_m + low[0], foot.y_m + low[1]},
                     {foot.x_m + high[0], foot.y_m + high[1]},
                     -dy * low[0] + dx * low[1],
                     -dy * high[0] + dx * high[1]});
    if (sides.back().from_offset_m > sides.back().to_offset_m) {
      std::swap(sides.back().from, sides.back().to);
      std::swap(sides.back().from_offset_m, sides.back().to_offset_m);
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.from_offset_m < b.from_offset_m; });
  return sides;
}

/// Where the edge at this offset ends, and its final offset.
std::pair<Corner, double> edge_end(const std::vector<Side>& sides, double offset_m, double width_m) {
  if (offset_m <= sides.front().from_offset_m) return {sides.front().from, sides.front().from_offset_m};
  for (const Side& side : sides) {
    if (offset_m > side.to_offset_m) continue;
    const double length_m = std::hypot(side.to[0] - side.from[0], side.to[1] - side.from[1]);
    const double share = (offset_m - side.from_offset_m) / (side.to_offset_m - side.from_offset_m);
    const double snap_m = std::min(0.2 * length_m, 0.25 * width_m);
    if (share * length_m < snap_m) return {side.from, side.from_offset_m};
    if ((1 - share) * length_m < snap_m) return {side.to, side.to_offset_m};
    return {{side.from[0] + share * (side.to[0] - side.from[0]),
             side.from[1] + share * (side.to[1] - side.from[1])},
            offset_m};
  }
  return {sides.back().to, sides.back().to_offset_m};
}

Corners lug_end(const meshes::Chamber& chamber, const meshes::ChamberFoot& foot) {
  const double dx = foot.x_m - chamber.tube.axis_x_m, dy = foot.y_m - chamber.tube.axis_y_m;
  const double length_m = std::hypot(dx, dy);
  const auto sides = seen_sides(chamber, foot, dx / length_m, dy / length_m);
  double low_m = -0.5 * chamber.lugs.width_m, high_m = 0.5 * chamber.lugs.width_m;
  const double first_m = sides.front().from_offset_m, last_m = sides.back().to_offset_m;
  if (high_m - low_m > last_m - first_m) {  // tapers
    low_m = first_m;
    high_m = last_m;
  }
  const double lean_m = std::max(first_m - low_m, 0.0) - std::max(high_m - last_m, 0.0);
  const double width_m = high_m - low_m;
  const auto low = edge_end(sides, low_m + lean_m, width_m), high = edge_end(sides, high_m + lean_m, width_m);
  Corners end = {low.first};
  if (sides.size() == 2 && low.second < sides[0].to_offset_m && sides[0].to_offset_m < high.second)
    end.push_back(sides[0].to);
  end.push_back(high.first);
  return end;
}

}  // namespace

PlaneSums polygon_sums(const Corners& corners) {
  PlaneSums sums{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double cross = a[0] * b[1] - b[0] * a[1];
    sums[0] += cross / 2;
    for (int d = 0; d < 2; ++d) {
      sums[d + 1] += cross * (a[d] + b[d]) / 6;
      sums[3] += cross * (a[d] * a[d] + a[d] * b[d] + b[d] * b[d]) / 12;
    }
  }
  return sums;
}

CircleAngles equal_angles(int n) {
  CircleAngles angles;
  for (int i = 0; i < n; ++i) angles.tube_rad.push_back(2 * pi * i / n);
  angles.housing_rad = angles.tube_rad;
  return angles;
}

CircleAngles angles_of(const MeshFile& mesh, const meshes::Chamber& chamber) {
  const auto collect = [&](const std::string& group, double x_m, double y_m) {
    std::vector<double> angles;
    for (const auto& quad : mesh.quads)
      if (mesh.boundary_names.at(quad.group) == group)
        for (const int node : quad.nodes)
          angles.push_back(std::atan2(mesh.y(node) - y_m, mesh.x(node) - x_m));
    std::sort(angles.begin(), angles.end());
    std::vector<double> distinct;
    for (const double angle : angles)
      if (distinct.empty() || (angle - distinct.back() > 1e-7 && angle - distinct.front() < 2 * pi - 1e-7))
        distinct.push_back(angle);
    return distinct;
  };
  return {collect("inner_wall", chamber.tube.axis_x_m, chamber.tube.axis_y_m), collect("housing_bore", 0, 0)};
}

ChamberOutlines outlines_of(const meshes::Chamber& chamber, const CircleAngles& angles) {
  const double x_m = chamber.tube.axis_x_m, y_m = chamber.tube.axis_y_m, r_m = tube_outer_m(chamber);
  const double housing_m = chamber.housing.outer_radius_m;
  ChamberOutlines outlines;
  outlines.tube_outer = circle(angles.tube_rad, x_m, y_m, r_m);
  outlines.tube_inner = circle(angles.tube_rad, x_m, y_m, chamber.tube.inner_radius_m);
  outlines.flange_outer = circle(angles.tube_rad, x_m, y_m, chamber.flanges.outer_radius_m);
  outlines.housing_outer = circle(angles.housing_rad, 0, 0, housing_m);
  outlines.housing_inner = circle(angles.housing_rad, 0, 0, chamber.housing.bore_radius_m);

  const double to_tube = std::atan2(y_m, x_m), half_m = 0.5 * chamber.webs.height_m;
  const double half_tube = std::asin(half_m / r_m);
  const double half_housing = std::asin(std::min(half_m, 0.8 * housing_m) / housing_m);
  outlines.web_tube_arc =
      arc(angles.tube_rad, x_m, y_m, r_m, to_tube + pi - half_tube, to_tube + pi + half_tube);
  outlines.web_housing_arc =
      arc(angles.housing_rad, 0, 0, housing_m, to_tube - half_housing, to_tube + half_housing);
  outlines.web = joined(reversed(outlines.web_tube_arc), reversed(outlines.web_housing_arc));

  const double hx = 0.5 * chamber.pads.size_x_m, hy = 0.5 * chamber.pads.size_y_m;
  const double half_lug = std::asin(0.5 * chamber.lugs.width_m / r_m);
  for (const auto& foot : chamber.feet) {
    const double direction = std::atan2(foot.y_m - y_m, foot.x_m - x_m);
    outlines.lug_tube_arcs.push_back(
        arc(angles.tube_rad, x_m, y_m, r_m, direction - half_lug, direction + half_lug));
    outlines.lug_ends.push_back(lug_end(chamber, foot));
    outlines.lugs.push_back(joined(reversed(outlines.lug_tube_arcs.back()), outlines.lug_ends.back()));
    outlines.pads.push_back({{foot.x_m - hx, foot.y_m - hy},
                             {foot.x_m + hx, foot.y_m - hy},
                             {foot.x_m + hx, foot.y_m + hy},
                             {foot.x_m - hx, foot.y_m + hy}});
  }
  return outlines;
}

std::map<std::string, PlaneSums> solid_sums(const meshes::Chamber& chamber, const CircleAngles& angles) {
  const ChamberOutlines outlines = outlines_of(chamber, angles);
  std::map<std::string, PlaneSums> sums;
  const auto add = [&](const std::string& part, const Corners& corners, double length_m) {
    const PlaneSums of_polygon = polygon_sums(corners);
    for (int i = 0; i < 4; ++i) sums[part][i] += length_m * of_polygon[i];
  };
  add("tube", outlines.tube_outer, chamber.tube.length_m);
  add("tube", outlines.tube_inner, -chamber.tube.length_m);
  add("flanges", outlines.flange_outer, 2 * chamber.flanges.thickness_m);
  add("flanges", outlines.tube_outer, -2 * chamber.flanges.thickness_m);
  add("housing", outlines.housing_outer, chamber.housing.length_m);
  add("housing", outlines.housing_inner, -chamber.housing.length_m);
  add("webs", outlines.web, chamber.webs.thickness_m * static_cast<double>(chamber.webs.z_m.size()));
  for (std::size_t i = 0; i < chamber.feet.size(); ++i) {
    add("lugs", outlines.lugs[i], 2 * chamber.lugs.thickness_m);
    add("pads", outlines.pads[i], 2 * chamber.pads.size_z_m);
  }
  return sums;
}

std::map<std::string, PlaneSums> mesh_sums(const MeshFile& mesh) {
  std::map<std::string, PlaneSums> sums;
  for (const auto& hex : mesh.hexes) {
    Corners corners;
    for (int i = 0; i < 4; ++i) corners.push_back({mesh.x(hex.nodes[i]), mesh.y(hex.nodes[i])});
    const double height_m = mesh.z(hex.nodes[4]) - mesh.z(hex.nodes[0]);
    const PlaneSums of_cell = polygon_sums(corners);
    for (int i = 0; i < 4; ++i) sums[mesh.volume_names.at(hex.group)][i] += height_m * of_cell[i];
  }
  return sums;
}
