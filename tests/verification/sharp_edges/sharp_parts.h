/// Small parts with sharp inner edges, drawn by gmsh's kernel, pulled apart between two faces along the line
/// through their centres.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sharp_parts {

using Point = std::array<double, 3>;  ///< mm

/// A plane face, by a box that holds its corners and no other face's.
struct LoadedFace {
  Point low{}, high{};
  Point centre{};
};

struct SharpPart {
  std::string name;
  std::function<void()> draw;  ///< into gmsh's model, in mm
  LoadedFace pulled, held;
  double force_N = 0;
};

/// L bracket, T joint, bracket with a gusset, stepped plate, pocket, slot, groove, cross of two bars, boss on
/// a plate, stepped bar.
std::vector<SharpPart> all();

/// Where sharp edges meet or end: three plates in a corner, a block without one corner, a rib on a plate with
/// upright and with sloped ends, crossing ribs.
std::vector<SharpPart> with_vertices();

/// Writes the STEP file and the scene beside it.
/// @return the scene's file
std::filesystem::path write_scene(const SharpPart& part, const std::filesystem::path& directory);

}  // namespace sharp_parts
