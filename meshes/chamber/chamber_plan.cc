#include "meshes/chamber/chamber_plan.h"

#include <algorithm>
#include <cmath>

#include "meshes/chamber/foot_plan.h"
#include "meshes/spacing/grading.h"
#include "meshes/spacing/plan_blocks.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

std::vector<double> equal_steps(double begin_m, double end_m, int n) {
  std::vector<double> result;
  for (int i = 0; i <= n; ++i) result.push_back(begin_m + (end_m - begin_m) * i / n);
  result.back() = end_m;
  return result;
}

class PlanBuilder {
public:
  PlanBuilder(const Chamber& chamber, const ChamberLayout& layout, const ChamberStations& stations,
              const ChamberSurfaces& surfaces, const ChamberMeshControl& control)
      : chamber_(chamber),
        layout_(layout),
        stations_(stations),
        surfaces_(surfaces),
        sizes_{layout.toe_size_m, layout.toe_size_m, layout.size_m, control.growth},
        n_wall_(control.cells_through_wall) {}

  Plan build() {
    add_tube_and_flanges();
    add_webs_and_housing();
    for (std::size_t i = 0; i < chamber_.feet.size(); ++i) add_foot_blocks(i);
    return std::move(plan_);
  }

private:
  void add_tube_and_flanges() {
    const std::array<double, 2> centre_m = {chamber_.tube.axis_x_m, chamber_.tube.axis_y_m};
    const double end_m = 0.5 * chamber_.tube.length_m, inner_m = layout_.flange_begin_m;
    const auto wall = add_circles(plan_, centre_m, wall_radii(), stations_.angles_rad);
    PlanBlock tube;
    add_quads(tube, wall, true, surfaces_.inner_wall, 0);
    tube.slabs = {
        {-end_m, end_m, tube_volume, surfaces_.tube_outside, surfaces_.tube_end_1, surfaces_.tube_end_2}};
    plan_.blocks.push_back(tube);
    tube_row_ = wall.back();

    const double outer_m = chamber_.flanges.outer_radius_m;
    PlanBlock flange;
    add_quads(flange, add_circles(plan_, centre_m, flange_radii(outer_m), stations_.angles_rad, tube_row_),
              true, 0, 0);
    flange.slabs = {
        {-end_m, -inner_m, flanges_volume, surfaces_.flange_1, surfaces_.covers, surfaces_.flange_1},
        {inner_m, end_m, flanges_volume, surfaces_.flange_2, surfaces_.flange_2, surfaces_.covers}};
    plan_.blocks.push_back(flange);
  }

  /// Cells grow from the weld toes inwards.
  std::vector<double> wall_radii() const {
    const double wall_m = chamber_.tube.wall_m;
    const double first = std::max(layout_.finest_toe_m() / wall_m, 1 / (std::exp2(n_wall_) - 1));
    std::vector<double> radii;
    for (const double share : geometric_fractions(n_wall_, first))
      radii.insert(radii.begin(), layout_.tube_outer_m - share * wall_m);
    radii.front() = chamber_.tube.inner_radius_m;
    return radii;
  }

  /// Radii of the flange's rows, fine at the tube.
  std::vector<double> flange_radii(double outer_m) const {
    const AxialSize size{{{layout_.tube_outer_m, sizes_.begin_m}}, sizes_.largest_m, sizes_.growth};
    return axial_stations(layout_.tube_outer_m, outer_m, size, 2);
  }

  /// The tube's outside from one edge of a plate to the other.
  struct Arc {
    std::vector<int> points;
    std::vector<double> from_first_rad;
  };
  Arc arc(double first_rad, double last_rad) const {
    const auto& angles = stations_.angles_rad;
    const auto distance = [](double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); };
    const auto closer = [&](double a, double b) { return distance(a, first_rad) < distance(b, first_rad); };
    auto j =
        static_cast<std::size_t>(std::min_element(angles.begin(), angles.end(), closer) - angles.begin());
    Arc result;
    const double start_rad = angles[j];
    const double tiny_rad = 0.5 * layout_.closest_m / layout_.tube_outer_m;
    double from_first_rad = 0;
    while (from_first_rad < last_rad - first_rad + tiny_rad) {
      result.points.push_back(tube_row_[j]);
      result.from_first_rad.push_back(from_first_rad);
      j = (j + 1) % angles.size();
      from_first_rad = angles[j] - start_rad;
      if (from_first_rad <= 0) from_first_rad += 2 * pi;
    }
    return result;
  }

  void add_webs_and_housing() {
    const WebLayout& web = layout_.web;
    const Arc tube = arc(web.first_rad, web.last_rad);
    const std::size_t n = tube.points.size();
    std::vector<double> angles;  // ascending: from the web's last edge to its first, then round to the last
    for (std::size_t j = n; j-- > 0;)
      angles.push_back(web.housing_first_rad + (web.housing_last_rad - web.housing_first_rad) *
                                                   (tube.from_first_rad[j] / tube.from_first_rad.back()));
    const double outer_m = chamber_.housing.outer_radius_m;
    ToeSizes around = sizes_;
    around.largest_m = std::min(sizes_.largest_m, coarsest_turn_rad * outer_m);
    const auto rest = between_toes(angles.back() * outer_m, (angles.front() + 2 * pi) * outer_m, around, 2);
    for (std::size_t i = 1; i + 1 < rest.size(); ++i) angles.push_back(rest[i] / outer_m);

    const double ring_m = outer_m - chamber_.housing.bore_radius_m;
    const int n_ring = std::max(2, static_cast<int>(std::lround(ring_m / sizes_.largest_m)));
    const auto ring =
        add_circles(plan_, {0, 0}, equal_steps(chamber_.housing.bore_radius_m, outer_m, n_ring), angles);
    const double housing_m = 0.5 * chamber_.housing.length_m;
    PlanBlock housing;
    add_quads(housing, ring, true, surfaces_.housing_bore, 0);
    housing.slabs = {{-housing_m, housing_m, housing_volume, surfaces_.housing_outside,
                      surfaces_.housing_end_1, surfaces_.housing_end_2}};

    std::vector<int> housing_row;
    for (std::size_t j = 0; j < n; ++j) housing_row.push_back(ring.back()[n - 1 - j]);
    const double length_m = 0.5 * (distance_m(tube.points[0], housing_row[0]) +
                                   distance_m(tube.points[n / 2], housing_row[n / 2]));
    ToeSizes along = sizes_;
    along.begin_m = layout_.toe_size_within(web.first_rad, web.last_rad);
    std::vector<double> shares = between_toes(0, length_m, along, 2);
    for (double& share : shares) share /= length_m;
    PlanBlock webs;
    add_quads(webs, add_ruled_rows(plan_, tube.points, housing_row, shares), false, 0, 0);
    for (std::size_t i = 0; i < surfaces_.webs.size(); ++i) {
      const int id = surfaces_.webs[i];
      webs.slabs.push_back({layout_.plates[i].begin_m, layout_.plates[i].end_m, webs_volume, id, id, id});
    }
    plan_.blocks.push_back(webs);
    plan_.blocks.push_back(housing);
  }

  void add_foot_blocks(std::size_t i) {
    const FootLayout& foot = layout_.feet[i];
    const Arc tube = arc(foot.first_rad, foot.last_rad);
    std::vector<double> columns_rad;
    for (const double angle : tube.from_first_rad)
      columns_rad.push_back(angle - 0.5 * (foot.last_rad - foot.first_rad));
    ToeSizes along = sizes_;
    along.begin_m = layout_.toe_size_within(foot.first_rad, foot.last_rad);
    FootBlocks blocks =
        add_foot(plan_, chamber_, layout_, i, tube.points, columns_rad, along, surfaces_.soles[i]);
    const double half_lug_m = 0.5 * chamber_.lugs.thickness_m, half_pad_m = 0.5 * chamber_.pads.size_z_m;
    for (const double z_m : {-chamber_.lugs.z_m, chamber_.lugs.z_m}) {
      const int lug = surfaces_.lugs[i], pad = surfaces_.pads[i];
      blocks.lug.slabs.push_back({z_m - half_lug_m, z_m + half_lug_m, lugs_volume, lug, lug, lug});
      blocks.pad.slabs.push_back({z_m - half_pad_m, z_m + half_pad_m, pads_volume, pad, pad, pad});
    }
    plan_.blocks.push_back(blocks.lug);
    plan_.blocks.push_back(blocks.pad);
  }

  double distance_m(int a, int b) const {
    return std::hypot(plan_.points[a][0] - plan_.points[b][0], plan_.points[a][1] - plan_.points[b][1]);
  }

  const Chamber& chamber_;
  const ChamberLayout& layout_;
  const ChamberStations& stations_;
  const ChamberSurfaces& surfaces_;
  ToeSizes sizes_;
  int n_wall_;
  Plan plan_;
  std::vector<int> tube_row_;  ///< points of the tube's outside
};

}  // namespace

Plan build_plan(const Chamber& chamber, const ChamberLayout& layout, const ChamberStations& stations,
                const ChamberSurfaces& surfaces, const ChamberMeshControl& control) {
  return PlanBuilder(chamber, layout, stations, surfaces, control).build();
}

}  // namespace meshes
