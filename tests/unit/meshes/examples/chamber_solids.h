/// The chamber's parts by plane integration, independent of the mesher: polygons times lengths. Lengths in m.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "meshes/chamber/chamber_geometry.h"
#include "tests/unit/meshes/examples/mesh_file.h"

using Corners = std::vector<std::array<double, 2>>;

/// Integrals of 1, x, y and x^2 + y^2 over an area, or over a volume.
using PlaneSums = std::array<double, 4>;

/// Exact for a polygon; positive if its corners run counter-clockwise.
PlaneSums polygon_sums(const Corners& corners);

/// Angles of the corners that stand for the circles about the tube's axis and about E'.
struct CircleAngles {
  std::vector<double> tube_rad, housing_rad;
};

/// n corners on every circle; for large n the round parts.
CircleAngles equal_angles(int n);

/// Those of the mesh, from its inner wall and bore.
CircleAngles angles_of(const MeshFile& mesh, const meshes::Chamber& chamber);

/// Outlines in the cross-section, counter-clockwise; rings as outside and inside.
struct ChamberOutlines {
  Corners tube_outer, tube_inner, flange_outer, housing_outer, housing_inner;
  Corners web;
  Corners web_tube_arc, web_housing_arc;
  std::vector<Corners> lugs, lug_tube_arcs, lug_ends, pads;
};

/// By the rules that chamber.h documents, from the ends of the plates' edges.
ChamberOutlines outlines_of(const meshes::Chamber& chamber, const CircleAngles& angles);

/// Volume sums of each volume group.
std::map<std::string, PlaneSums> solid_sums(const meshes::Chamber& chamber, const CircleAngles& angles);

/// The same of the mesh's cells; exact for cells between planes normal to z.
std::map<std::string, PlaneSums> mesh_sums(const MeshFile& mesh);

/// Area of each feature by its outlines.
std::map<std::string, double> feature_areas(const meshes::Chamber& chamber, const CircleAngles& angles);
