#include "meshes/chamber/chamber_hot_spots.h"

#include <algorithm>
#include <cmath>

namespace meshes {

namespace {

const double near_walls = 0.4, far_walls = 1.0;  // distances of a path's points from the toe, in walls
const double clear_walls = 0.4;                  // between a path and other plates

/// Where paths cross a plate's toe: they may move to a break point nearby.
struct PathPlaces {
  double middle_z_m = 0;
  double low_end_m = 0, middle_m = 0, high_end_m = 0;  ///< arc lengths
};

class HotSpots {
public:
  HotSpots(const Chamber& chamber, const ChamberLayout& layout, BreakPoints& arcs, BreakPoints& stations)
      : chamber_(chamber), layout_(layout), arcs_(arcs), stations_(stations) {}

  PathPlaces places_on(const Plate& plate) {
    const double r_m = layout_.tube_outer_m, wall_m = chamber_.tube.wall_m;
    PathPlaces places;
    places.middle_z_m = stations_.add_or_snap(0.5 * (plate.begin_m + plate.end_m));
    places.middle_m = arcs_.add_or_snap(0.5 * (plate.first_rad + plate.last_rad) * r_m);
    places.low_end_m = arcs_.add_or_snap(plate.first_rad * r_m + wall_m);
    places.high_end_m = arcs_.add_or_snap(plate.last_rad * r_m - wall_m);
    return places;
  }

  void add_paths(const Plate& plate, const PathPlaces& places) {
    const double first_m = plate.first_rad * layout_.tube_outer_m;
    const double last_m = plate.last_rad * layout_.tube_outer_m;
    const bool last_is_upper = point(last_m, 0)[1] > point(first_m, 0)[1];
    const std::string first = last_is_upper ? "lower" : "upper", last = last_is_upper ? "upper" : "lower";
    add_around(plate, plate.name + ", " + first + " edge", first_m, places.middle_z_m, -1);
    add_around(plate, plate.name + ", " + last + " edge", last_m, places.middle_z_m, 1);
    for (const int side : {-1, 1}) {
      const std::string face = plate.name + (side < 0 ? ", back face, " : ", front face, ");
      const double toe_m = side < 0 ? plate.begin_m : plate.end_m;
      add_along(plate, face + "middle", places.middle_m, toe_m, side);
      add_along(plate, face + first + " end", places.low_end_m, toe_m, side);
      add_along(plate, face + last + " end", places.high_end_m, toe_m, side);
    }
  }

  ChamberHotSpots take() { return {std::move(hot_spots_), std::move(covered_)}; }

private:
  void add_around(const Plate& plate, const std::string& name, double toe_m, double z_m, int direction) {
    const double wall_m = chamber_.tube.wall_m;
    double near_m = toe_m + direction * near_walls * wall_m, far_m = toe_m + direction * far_walls * wall_m;
    if (!is_free(plate, far_m, z_m)) return covered_.push_back(name);
    place(arcs_, near_m, far_m);
    toe_m = arcs_.add_or_snap(toe_m);
    hot_spots_.push_back({name, wall_m, point(toe_m, z_m), point(near_m, z_m), point(far_m, z_m)});
  }

  void add_along(const Plate& plate, const std::string& name, double arc_m, double toe_m, int direction) {
    const double wall_m = chamber_.tube.wall_m;
    double near_m = toe_m + direction * near_walls * wall_m, far_m = toe_m + direction * far_walls * wall_m;
    if (!is_free(plate, arc_m, far_m)) return covered_.push_back(name);
    place(stations_, near_m, far_m);
    toe_m = stations_.add_or_snap(toe_m);
    hot_spots_.push_back({name, wall_m, point(arc_m, toe_m), point(arc_m, near_m), point(arc_m, far_m)});
  }

  /// Vertices at both points; an edge that is closer than cells can be short takes one's place.
  static void place(BreakPoints& breaks, double& near_m, double& far_m) {
    near_m = breaks.add_or_snap(near_m);
    far_m = breaks.add_or_snap(far_m);
  }

  /// Whether no other plate and no flange covers the point of the tube's outside or comes close to it.
  bool is_free(const Plate& own, double arc_m, double z_m) const {
    const double clear_m = clear_walls * chamber_.tube.wall_m, rounding_m = 1e-9 * layout_.tube_outer_m;
    if (std::abs(z_m) > layout_.flange_begin_m - clear_m + rounding_m) return false;
    for (const Plate& plate : layout_.plates) {
      if (&plate == &own) continue;
      const double middle_rad = 0.5 * (plate.first_rad + plate.last_rad);
      const double from_middle_rad =
          std::remainder(arc_m / layout_.tube_outer_m - middle_rad, 2 * std::acos(-1.0));
      const double half_m = 0.5 * (plate.last_rad - plate.first_rad) * layout_.tube_outer_m;
      const bool at_angle = std::abs(from_middle_rad) * layout_.tube_outer_m < half_m + clear_m - rounding_m;
      const bool at_z =
          z_m > plate.begin_m - clear_m + rounding_m && z_m < plate.end_m + clear_m - rounding_m;
      if (at_angle && at_z) return false;
    }
    return true;
  }

  std::array<double, 3> point(double arc_m, double z_m) const {
    const PlanePoint p = on_tube(chamber_, layout_, arc_m / layout_.tube_outer_m);
    return {p[0], p[1], z_m};
  }

  const Chamber& chamber_;
  const ChamberLayout& layout_;
  BreakPoints& arcs_;
  BreakPoints& stations_;
  std::vector<HotSpot> hot_spots_;
  std::vector<std::string> covered_;
};

}  // namespace

ChamberHotSpots place_hot_spots(const Chamber& chamber, const ChamberLayout& layout, BreakPoints& arcs,
                                BreakPoints& stations) {
  HotSpots hot_spots(chamber, layout, arcs, stations);
  std::vector<PathPlaces> places;
  for (const Plate& plate : layout.plates) places.push_back(hot_spots.places_on(plate));
  for (std::size_t i = 0; i < places.size(); ++i) hot_spots.add_paths(layout.plates[i], places[i]);
  return hot_spots.take();
}

}  // namespace meshes
