/// What a picture of ports shows: the surface with a colour per port, whole and cut open.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/write/drawing/cut_surface.h"

class vtkPolyData;

namespace pipelines {

/// The colour of port i of n: told apart by the colour-blind up to twelve.
Colour port_colour(std::size_t i);

/// Cell arrays of the surfaces.
namespace port_arrays {
inline constexpr const char* colour = "colour";  ///< as shown
inline constexpr const char* id = "id";          ///< as a colour: (0, 1, 0) no port, (0, 1, i) port i from 1
}  // namespace port_arrays

struct PortShape {
  std::shared_ptr<vtkPolyData> surface, edges;
};

struct PortBody {
  std::vector<std::string> ports;
  PortShape whole;
  PortShape half;                     ///< the part left by the cut; empty without one
  std::shared_ptr<vtkPolyData> face;  ///< face of the cut; empty without one
};

/// @param vtu  file of write_port_surface
/// @throws FileError naming the file if it cannot be read or has no ports
PortBody read_port_body(const std::filesystem::path& vtu, const std::optional<CutPlane>& cut);

}  // namespace pipelines
