/// Decisions taken before any node exists: core radius, loaded zones, fillet fans, radial rows. Lengths in m.
/// "Small" and "big" are the two segments at a shoulder; a fillet lies on the surface of the small one.
#pragma once

#include <vector>

#include "meshes/shaft.h"

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
  double depth_m = 0;                   ///< of the fan, into the big segment and below the small radius
  double first_cell_m = 0;              ///< size of the cells at the arc (or at the sharp corner)
  int n_half_arc = 0;                   ///< cells on each half of the arc
  std::vector<double> depth_fractions;  ///< cell boundaries of the fan from the arc (0) to its outer edge (1)
  int n_below = 0;                      ///< rows between the core and the fan, or the small surface if sharp
  bool has_shoulder_face = false;       ///< an annulus remains above the fillet

  int n_depth() const { return static_cast<int>(depth_fractions.size()) - 1; }
};

struct SegmentLayout {
  double begin_m = 0, end_m = 0, radius_m = 0, shift_m = 0;
  bool is_port = false;
  double own_fillet_begin_m = 0, own_fillet_end_m = 0;  ///< fillets on this segment's own surface
  double zone_begin_m = 0, zone_end_m = 0;      ///< loaded zone (the bare cylinder if the segment is no port)
  double column_begin_m = 0, column_end_m = 0;  ///< between the fans
  double inner_radius_m = 0;  ///< where the eccentric shift begins; the core's radius if concentric
  int n_inner_rows = 0;       ///< from the core to the inner radius if eccentric, else to the surface
  int n_outer_rows = 0;       ///< from the inner radius to the surface; 0 if concentric

  bool is_eccentric() const { return shift_m != 0; }
};

struct ShaftLayout {
  double core_radius_m = 0;
  std::vector<SegmentLayout> segments;
  std::vector<Junction> junctions;  ///< one less than segments
};

/// @param shaft, control have passed check_shaft
ShaftLayout lay_out(const Shaft& shaft, const ShaftMeshControl& control);

}  // namespace meshes
