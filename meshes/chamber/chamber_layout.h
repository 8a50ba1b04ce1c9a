/// The chamber's derived geometry: where plates meet the tube, the housing and the pads. Angles in rad,
/// counter-clockwise from +x, about the tube's axis unless said otherwise. Lengths in m.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "meshes/chamber/chamber_geometry.h"

namespace meshes {

using PlanePoint = std::array<double, 2>;  ///< x, y

/// Wanted of one cell around the tube or the housing, at most.
constexpr double coarsest_turn_rad = 0.25;

/// The webs in the cross-section. Tube angles ascend where housing angles (about E') descend.
struct WebLayout {
  double first_rad = 0, last_rad = 0;                  ///< on the tube's outside
  double housing_first_rad = 0, housing_last_rad = 0;  ///< on the housing's outside; first > last
};

/// Where a lug ends on its pad. Offsets are measured across the strip, positive to the left of the direction
/// from the tube's axis to the foot.
struct PadContact {
  std::vector<double> offsets_m;   ///< ascending: an end, the pad's corner if it is covered, an end
  std::vector<PlanePoint> points;  ///< absolute
};

struct FootLayout {
  double direction_rad = 0;            ///< from the tube's axis to the foot
  double first_rad = 0, last_rad = 0;  ///< on the tube's outside
  PadContact contact;
  double sole_sign = -1;  ///< the loaded side: -1 the underside, +1 the topside
};

/// A plate that is welded to the tube's outside.
struct Plate {
  std::string name;                    ///< "web 1", "lug 2 front"
  double first_rad = 0, last_rad = 0;  ///< on the tube's outside
  double begin_m = 0, end_m = 0;       ///< range in z
};

/// A place on the tube's outside, near which weld toes get cells of their own size.
struct FinePlace {
  double arc_m = 0;  ///< from the direction +x
  double z_m = 0;
  double size_m = 0;
};

struct ChamberLayout {
  double tube_outer_m = 0;
  double size_m = 0;          ///< away from the weld toes
  double toe_size_m = 0;      ///< at the weld toes, but for fine places
  double closest_m = 0;       ///< smallest distance of edges and stations
  double flange_begin_m = 0;  ///< inner face of the flange at the front
  WebLayout web;
  std::vector<FootLayout> feet;
  std::vector<Plate> plates;  ///< webs, then the lugs of each foot, front and back
  std::vector<FinePlace> fine_places;
  double fine_reach_m = 0;  ///< distance from a fine place beyond which toes have their usual cells

  /// Size of the cells across a toe that runs around the tube at z_m.
  double toe_size_at_z(double z_m) const;

  /// Size of the cells across the toes that run along the tube within a range of angles.
  double toe_size_within(double first_rad, double last_rad) const;

  /// Size of the smallest cells across any toe.
  double finest_toe_m() const;

private:
  double toe_size_at_distance(const FinePlace& place, double distance_m) const;
};

/// @param chamber with sizes in their ranges
ChamberLayout lay_out(const Chamber& chamber, const ChamberMeshControl& control);

PlanePoint on_circle(double centre_x_m, double centre_y_m, double radius_m, double angle_rad);

/// Points of the tube's outside.
PlanePoint on_tube(const Chamber& chamber, const ChamberLayout& layout, double angle_rad);

}  // namespace meshes
