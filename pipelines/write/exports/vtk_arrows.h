/// Lines and vectors as a VTK file that ParaView opens: outlines of bodies, and forces to draw as arrows.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

/// A vector at a point; 0 where a line's points have none.
struct PlacedVector {
  std::string name;
  std::array<double, 3> at_m{}, value{};
};

/// Poly data: the vectors' points as vertices, with the point fields `field` (3 components) and "number", the
/// vectors from 1 (0 on lines), whose names are the field data "names"; then the lines.
/// @throws FileError naming the file if it cannot be written
void write_arrows_vtp(const std::filesystem::path& path, const std::string& field,
                      const std::vector<PlacedVector>& vectors,
                      const std::vector<std::vector<std::array<double, 3>>>& lines);

}  // namespace pipelines
