/// Small parts as shops have them, drawn by gmsh's OpenCASCADE: every form of centre hole, drill tips,
/// pointed ends, faces that are tangent, threads as grooves, swept and lofted faces.
#pragma once

#include <string>
#include <vector>

struct CadPart {
  std::string name;
  void (*draw)();  ///< into gmsh's current model, in mm; the solids are synchronised afterwards
  int n_tips = 0;  ///< points at which a hollow comes to a tip
  std::vector<std::string> refusal{};  ///< words of it; empty: the part is meshed
};

/// More than forty parts, and those that are refused.
const std::vector<CadPart>& cad_parts();
