/// What is seen of ports in a picture of which every pixel tells its port.
#pragma once

#include <cstddef>
#include <vector>

namespace pipelines {

struct PortPixels {
  int width = 0, height = 0;
  std::vector<std::size_t> port;  ///< row by row from below; 0: none, else the port from 1
};

struct SeenPort {
  std::size_t n_pixels = 0;
  /// A pixel well inside what is seen of the port, near its middle and, of several pieces, near the upper or
  /// lower edge of the picture; y upwards.
  double x = 0, y = 0;
};

/// What is seen of each port, one entry per port.
std::vector<SeenPort> seen_ports(const PortPixels& pixels, std::size_t n_ports);

}  // namespace pipelines
