/// Blocks of quadrilaterals in the plane, each swept along z over its own ranges. Lengths in m.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "meshes/values/hex_mesh.h"

namespace meshes {

/// Corners counter-clockwise; edge i runs from corner i to corner i + 1.
struct PlanQuad {
  std::array<int, 4> corners{};
  std::array<int, 4> edge_ids{};  ///< boundary group of the face swept by the edge; 0: the slab's side_id
};

/// A range in z over which a block is swept, and its groups.
struct Slab {
  double begin_m = 0, end_m = 0;
  int volume_id = 0;
  int side_id = 0;              ///< faces parallel to z
  int low_id = 0, high_id = 0;  ///< faces at begin and end
};

struct PlanBlock {
  std::vector<PlanQuad> quads;
  std::vector<Slab> slabs;
};

/// Blocks meet where they share points. Blocks that do not may overlap if their ranges in z do not.
struct Plan {
  std::vector<std::array<double, 2>> points;  ///< x, y
  std::vector<PlanBlock> blocks;
};

/// A face is in a boundary group if no second cell shares it.
/// @param stations_m ascending; they contain the ends of all slabs up to rounding
HexMesh sweep(const Plan& plan, const std::vector<double>& stations_m);

/// What is swept in one volume group, between straight edges.
struct SweptVolume {
  std::size_t n_cells = 0;
  double volume_m3 = 0;
  std::array<double, 3> first_m4{};   ///< integrals of x, y, z
  std::array<double, 6> second_m5{};  ///< integrals of xx, yy, zz, xy, yz, xz
};

/// Sizes of all volume groups by their ids, without sweeping anything.
/// @param stations_m  as sweep takes them: they count the cells
std::map<int, SweptVolume> swept_volumes(const Plan& plan, const std::vector<double>& stations_m);

}  // namespace meshes
