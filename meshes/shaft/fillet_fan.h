/// The blocks around one junction: five at a fillet, none but matched rows at a sharp corner or a bore step.
///
///            |  above  |            local axes: t along z, positive into the big segment; r
///   arc  ___/|_________|  r_top
///  ______/ \ |  right  |  r_small   lower: first half of the arc to the line r = r_small - depth
///  | lower  \|_________|  - depth   right: second half of the arc to the plane t = depth
///  |      below        |            the two meet along the ray from the middle of the arc to the corner
///  -f        0      depth  r_core
#pragma once

#include <array>
#include <vector>

#include "meshes/shaft/meridian.h"
#include "meshes/shaft/row_radii.h"

namespace meshes {

/// A meridian in the making; points are shared by their index.
struct BlockMesh {
  std::vector<MeridianPoint> points;
  std::vector<MeridianQuad> quads;
  std::vector<MeridianEdge> edges;

  int add_point(double z_m, double r_m);
  std::vector<int> add_line(double z_m, const std::vector<double>& radii_m);
  /// Turns the corners counter-clockwise if they are not.
  void add_quad(std::array<int, 4> corners, int segment);
};

/// Where the columns of the two segments begin: points from the base outwards.
struct JunctionFaces {
  std::vector<int> left, right;
};

/// @param left index of the junction: the segment on the side of smaller z
JunctionFaces build_junction(BlockMesh& mesh, const ShaftLayout& layout, const RadiiPlan& plan, int left,
                             const SurfaceTable& surfaces);

}  // namespace meshes
