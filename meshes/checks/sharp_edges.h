/// Sharp re-entrant edges of a finished mesh.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"
#include "meshes/values/hex_mesh.h"

namespace meshes {

/// A boundary group: its name, and the thickness of the plate whose surface it is.
struct PlateSurface {
  std::string name;
  double thickness_m = 0;
  double radius_m = 0;  ///< radius of a cylinder along z; 0: flat, or not all of it round
  double axis_x_m = 0, axis_y_m = 0;
};

constexpr double thirty_degrees_rad = 0.52359877559829887;

/// The mesh edges at which two boundary quads turn towards each other across the outside: their outward
/// normals differ by more than `smallest_turn_rad`, and the material fills more than half a turn. One entry
/// for each pair of groups, in the order of their ids, named "lug 1/tube outside" with the group of the
/// larger id first; distance: the smaller thickness of the two, on the thicker plate's own surface that
/// plate's thickness, at most twice the smaller one; pieces: the mesh edges, those on a cylinder along it to
/// a two hundredth of that distance: finer chords cost more than they tell.
/// @param surfaces by boundary id; groups that are missing have no sharp edges
std::vector<SharpEdge> find_sharp_edges(const HexMesh& mesh, const std::map<int, PlateSurface>& surfaces,
                                        double smallest_turn_rad = thirty_degrees_rad);

}  // namespace meshes
