/// A stepped shaft, solid or bored, with shoulder fillets and eccentric seats, and how fine its mesh is; so
/// are drums: shafts with a wide bore in the middle.
#pragma once

#include <string>
#include <vector>

namespace meshes {

/// One cylindrical length of the shaft.
struct ShaftSegment {
  std::string name;    ///< unique; also the port's name if it is one
  double begin_m = 0;  ///< z; end_m > begin_m
  double end_m = 0;
  double diameter_m = 0;
  double eccentricity_m = 0;  ///< offset of this segment's axis
  bool is_port = false;       ///< its surface takes load; see Shaft
  /// Direction of the offset, counter-clockwise from +x (the body's xi axis).
  double eccentricity_angle_rad = 0;
  double bore_m = 0;        ///< diameter of the hole along z, concentric with the z axis; 0: solid
  std::string bore_port{};  ///< name of the port that the whole inside of the bore is; empty: none
};

/// Segments from left to right without gaps. fillets_m[i] is the radius at the shoulder between segments i
/// and i+1: at its inner corner, on the surface of the smaller diameter; 0: sharp corner. The loaded zone of
/// a port is centred in its segment: the segment less, at both ends, the larger of the fillets that lie on
/// its own surface.
///
/// What is meshed:
/// - Eccentric segments are thicker than both neighbours, and these are concentric; each has its own
///   direction. The bore stays concentric. Offset at most 0.9 of the ring between the surface and the larger
///   of the neighbours' radius plus fillet (alone, without neighbours: 0.9 of the outer 70 % of its wall; a
///   solid one: of 28 % of its radius).
/// - A fillet takes at most 0.6 of the length of the segment that carries it if the other neighbour is
///   thinner, else 0.9; two fillets on one segment (a relief groove: thinner than both neighbours) together
///   0.95; a port keeps a loaded zone of at least 0.1 of its length.
/// - Bores of 0.01 to 0.98 of the diameter; the wall under a fillet is at least half the fillet, measured
///   to the widest bore of the segment and its two neighbours.
/// - Bore steps (neighbours with different bores, or a bore that ends at a solid segment) between concentric
///   segments, where the outside is flush or has a sharp shoulder; at least 0.01 of the smaller diameter is
///   left around the wider bore. The segment with the narrow bore is long enough for a row of cells to climb,
///   at a slope below 0.8, from the bore step to the fan of a fillet at its other end or to the bore step
///   there.
/// - Every wall has at least two cells through it, with subdivisions at least as many. In a thin one
///   cells are at most 64 walls / n_sectors long, but not shorter than around, and grow half as fast as
///   control.growth.
struct Shaft {
  std::vector<ShaftSegment> segments;
  std::vector<double> fillets_m;
};

/// Distance from a shoulder without a fillet within which no stress is reported, on blocks and tetrahedra
/// alike.
/// @param small_diameter_m  the smaller diameter of the two segments
inline double sharp_shoulder_distance_m(double small_diameter_m) {
  return 0.1 * small_diameter_m;
}

struct ShaftMeshControl {
  static constexpr double steepest_growth = 1;  ///< above, neighbouring cells differ by more than e

  int cells_per_fillet_quarter = 8;  ///< even, >= 2
  std::vector<int> fillet_cells;     ///< the same for each of Shaft::fillets_m; empty: alike; 0: as above
  int n_sectors = 16;                ///< around, a multiple of 4, >= 8
  double growth = 1.0;  ///< slope of the axial cell size away from fillets; cells grow by at most e^growth
  double largest_cell_m = 0;         ///< axial; 0: chosen from diameters and walls
  double axial_share = 1;            ///< factor of the axial size that is chosen where largest_cell_m is 0
  double rows_factor = 1;            ///< factor of the number of radial rows, away from fillets' fans; >= 1
  double min_scaled_jacobian = 0.3;  ///< refused below
  /// The blocks are laid out for cells this many times larger, each of which is then cut into as many along
  /// every edge. Divides n_sectors / 4 and half of the cells of each fillet. Meshes whose counts are in
  /// proportion to it, and growth and largest_cell_m to its reciprocal, are systematic: all their cells
  /// shrink alike.
  int subdivisions = 1;
  /// Few cells away from the fillets' arcs, for a mesh that is refined locally afterwards: they grow three
  /// times from row to row of a fan, walls have one row, columns two cells at least.
  bool lean = false;

  /// Whether cells are cut after the blocks are laid out.
  bool is_cut_later() const { return lean || subdivisions > 1; }
  /// Cells on a quarter of one of Shaft::fillets_m.
  int cells_at(int fillet) const {
    const bool own = std::size_t(fillet) < fillet_cells.size() && fillet_cells[std::size_t(fillet)] > 0;
    return own ? fillet_cells[std::size_t(fillet)] : cells_per_fillet_quarter;
  }
};

}  // namespace meshes
