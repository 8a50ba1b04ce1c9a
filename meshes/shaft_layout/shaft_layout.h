/// Decisions taken before any node exists: core radius, loaded zones, fillet fans, radial rows. Lengths in m.
/// "Small" and "big" are the two segments at a shoulder; a fillet lies on the surface of the small one.
/// "Narrow" and "wide" are the two segments at a bore step: the one with the smaller hole (or none) and the
/// one with the larger.
#pragma once

#include <vector>

#include "meshes/shaft_layout/shaft_geometry.h"

namespace meshes {

/// The plane where two segments meet.
struct Junction {
  enum class Kind {
    flush,   ///< equal diameters, no shoulder
    sharp,   ///< shoulder without a fillet
    fillet,  ///< shoulder with a fillet, surrounded by a fan of five blocks
  };
  Kind kind = Kind::flush;
  int small = 0, big = 0;  ///< segment indices
  int direction = 1;       ///< +1 if the big segment lies on the side of larger z
  double z_m = 0;
  double small_radius_m = 0;
  double fillet_m = 0;
  double top_radius_m = 0;              ///< where the fillet ends on the shoulder: small radius + fillet
  double depth_m = 0;                   ///< depth of the fan into the big segment and below the small radius
  double first_cell_m = 0;              ///< size of the cells at the arc (or at the sharp corner)
  int n_half_arc = 0;                   ///< cells on each half of the arc
  std::vector<double> depth_fractions;  ///< cell boundaries of the fan from the arc (0) to its outer edge (1)
  bool has_shoulder_face = false;       ///< an annulus remains above the fillet

  bool is_bore_step = false;
  int narrow = 0, wide = 0;      ///< segment indices at a bore step
  double step_radius_m = 0;      ///< radius of the wide bore
  double step_cell_m = 0;        ///< size of the cells at the bore step's corner
  double bore_border_m = 0;      ///< z where the bores of the two segments meet, if both are bored alike
  int n_floor_before_plane = 0;  ///< cells of the fan's floor on the small segment's side; 0: equal cells

  bool has_fan() const { return kind == Kind::fillet; }
  int n_depth() const { return static_cast<int>(depth_fractions.size()) - 1; }
};

/// Rows run from the base radius to the surface. A segment that is eccentric, or narrow at a bore step, has
/// one boundary between rows that is kept at a wanted radius: its line.
struct SegmentLayout {
  double begin_m = 0, end_m = 0, radius_m = 0;
  double shift_x_m = 0, shift_y_m = 0;
  double bore_radius_m = 0;  ///< 0: solid
  /// Radius of the bore, or of the core that the solid segments side by side share.
  double base_radius_m = 0;
  bool is_port = false;
  double own_fillet_begin_m = 0, own_fillet_end_m = 0;  ///< fillets on this segment's own surface
  double zone_begin_m = 0, zone_end_m = 0;      ///< loaded zone (the bare cylinder if the segment is no port)
  double column_begin_m = 0, column_end_m = 0;  ///< between the fans
  double inner_radius_m = 0;  ///< where the eccentric shift begins; the base radius if concentric
  double line_begin_m = 0, line_end_m = 0;  ///< radius of the line on the segment's two faces; 0: no line
  int n_inner_rows = 0;                     ///< from the base to the line, or to the surface
  int n_outer_rows = 0;                     ///< from the line to the surface; 0 without a line

  bool is_bored() const { return bore_radius_m > 0; }
  bool is_eccentric() const { return shift_x_m != 0 || shift_y_m != 0; }
  bool has_line() const { return line_begin_m > 0; }
  int n_rows() const { return n_inner_rows + n_outer_rows; }
  double wall_m() const { return radius_m - base_radius_m; }
  /// Whether the column is so short that rows have to lie alike on both of its faces.
  bool is_short() const { return column_end_m - column_begin_m < wall_m(); }
};

struct ShaftLayout {
  std::vector<SegmentLayout> segments;
  std::vector<Junction> junctions;  ///< one less than segments

  /// Line of the small or big segment at the junction with this index; 0: none.
  double line_at(int junction, int segment) const {
    return segment == junction ? segments[segment].line_end_m : segments[segment].line_begin_m;
  }
};

/// Radius inside which nothing is shifted where the eccentric segment is the whole shaft.
double lone_inner_radius(const ShaftSegment& segment);

/// The mesh that control.subdivisions cuts up: counts divided, sizes multiplied by it; it keeps
/// control.subdivisions.
ShaftMeshControl before_subdivision(const ShaftMeshControl& control);

/// Counts and fractions of the same blocks, each cell cut into n along every edge.
ShaftLayout subdivided(const ShaftLayout& layout, int n);

/// @param shaft, control have passed check_shaft; control.subdivisions > 1: control is before_subdivision
/// @throws GeometryRefused if a bore step lies so close to a shoulder that no row can reach from one to
///         the other
ShaftLayout lay_out(const Shaft& shaft, const ShaftMeshControl& control);

}  // namespace meshes
