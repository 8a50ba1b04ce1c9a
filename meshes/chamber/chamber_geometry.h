/// A chamber of a vibratory mill: tube, flanges, exciter housing, webs, lugs and pads, and how fine its mesh
/// is.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace meshes {

/// The tube that holds the charge; its axis is parallel to z and passes through C = (axis_x, axis_y).
struct ChamberTube {
  double inner_radius_m = 0;
  double wall_m = 0;  ///< 0.01 to 0.3 of the inner radius
  double length_m = 0;
  double axis_x_m = 0, axis_y_m = 0;
};

/// Two rings around the tube, flush with its ends.
struct ChamberFlanges {
  double outer_radius_m = 0;  ///< at least one wall above the tube's outside, at most twice the tube's
  double thickness_m = 0;     ///< at most a quarter of the tube's length
};

/// The ring about E' that holds the exciter's bearings, middle at z = 0.
struct ChamberHousing {
  double outer_radius_m = 0;  ///< bore below 0.95 of it
  double bore_radius_m = 0;
  double length_m = 0;
};

/// Plates between tube and housing, symmetrical about the line E'C. Towards the housing they taper to a
/// height of 1.6 housing radii where `height_m` is more; the taper of an edge is at most 1 in 2.
struct ChamberWebs {
  double thickness_m = 0;
  double height_m = 0;  ///< across E'C at the tube: at least 3 walls, at most 1.2 of the tube's outer radius
  std::vector<double> z_m;  ///< mid-planes, 1 to 8; within the housing's length
};

/// Plates that carry the pads, at z = +-z_m for every foot: straight strips from the tube towards the foot.
/// They end on the sides of the pad that face the tube, but on none that they would meet at less than 33
/// degrees. Where a strip is wider than these sides it tapers to their ends; where it would miss one end it
/// leans; an edge that would end within a fifth of a side from its corner (and a quarter of the width) runs
/// to the corner. No edge shifts by more than 1 in 2.
struct ChamberLugs {
  double thickness_m = 0;
  double width_m = 0;  ///< at least 3 walls, at most the tube's outer radius
  double z_m = 0;
};

/// Blocks with faces along the axes, centred at the feet, at z = +-ChamberLugs::z_m.
struct ChamberPads {
  double size_x_m = 0, size_y_m = 0;
  double size_z_m = 0;  ///< at least the lug's thickness
};

struct ChamberFoot {
  double x_m = 0, y_m = 0;
};

/// 1 to 4 feet. Parts that share a range of z keep clear of each other in the cross-section by at least one
/// wall, and plates that overlap around the tube keep clear in z by as much.
struct Chamber {
  ChamberTube tube;
  ChamberFlanges flanges;
  ChamberHousing housing;
  ChamberWebs webs;
  ChamberLugs lugs;
  ChamberPads pads;
  std::vector<ChamberFoot> feet;
};

/// A place on a weld toe. Toes of all plates that pass it within 1.5 walls get smaller cells than the others,
/// but none smaller than a tenth of their distance.
struct FineToe {
  std::array<double, 3> at_m{};
  double walls = 0;  ///< size of the cells across toes at the place itself, in walls of the tube
};

struct ChamberMeshControl {
  static constexpr int most_cells_through_wall = 20;
  static constexpr double steepest_growth = 2;  ///< searches go below any other limit, so there is none

  /// Thinner towards the outside where toe cells are small, each at most twice the one outside it.
  int cells_through_wall = 2;
  double size_m = 0;       ///< size of the cells away from weld toes; 0: 0.15 of the tube's outer radius
  double growth = 0.7;     ///< slope of the cell size away from the weld toes
  double toe_walls = 0.6;  ///< size of the cells at the weld toes, in walls of the tube
  std::vector<FineToe> fine_toes;
  /// Whether vertices at the points of hot spots are left out, for meshes whose cells are cut later: they are
  /// in the way all around and along the tube. Goes with toe_walls = lean_toe_walls: cut twice, such a cell
  /// ends about where the nearer point lies, 0.4 walls from the toe.
  bool lean = false;
  static constexpr double lean_toe_walls = 1.6;
  double min_scaled_jacobian = 0.3;  ///< refused below
};

}  // namespace meshes
