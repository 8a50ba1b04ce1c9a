/// Edges of a mesh that are sharp and re-entrant, found by looking at its boundary.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"

namespace meshes {

/// Edges where two boundary faces meet with their outward normals more than 60 degrees apart and the corner
/// turned into the material, and 25 degrees between two features, by curved faces where they are: one entry
/// per pair of features, "<one>/<other>". Fillets with six cells per circle and more stay below 60 degrees,
/// and those of eight and more below 25 at their seams.
std::vector<SharpEdge> reentrant_edges(const CellMesh& mesh, const std::map<int, std::string>& names,
                                       double distance_m);

/// An edge of a boundary face: from its corner `edge` to the next one.
struct SharpSide {
  std::size_t face = 0, edge = 0;
};
/// The mesh edges of reentrant_edges, each by the two faces that meet there.
std::vector<std::array<SharpSide, 2>> sharp_sides(const CellMesh& mesh);

/// Name of the sharp edge between the features of two groups.
std::string name_of_pair(const std::map<int, std::string>& names, int id, int other_id);

/// A body's size, however it is turned.
struct BodySize {
  double area_m2 = 0, volume_m3 = 0;
  double second_moment_m5 = 0;  ///< integral of the squared distance from the centre of the volume
};

/// @param surface  a closed one: triangles with their corners counter-clockwise seen from outside
BodySize size_within(const std::vector<std::array<Point, 3>>& surface);

/// How far stress is left out around edges that nothing else is said of: 1 % of the diagonal of a box with
/// the body's radius of gyration, but at most volume over surface, a quarter of a rod's diameter and half a
/// plate's thickness: a whole section, with what is next to the edge, is never left out.
double usual_exclusion_m(const BodySize& size);

/// Length of the box around the mesh from corner to corner.
double diagonal_m(const CellMesh& mesh);

}  // namespace meshes
