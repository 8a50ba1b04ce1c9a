#include "pipelines/write/pictures/port_visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pipelines {
namespace {

/// Steps, along rows and columns, from each pixel to the nearest of another port or outside.
std::vector<int> depths(const PortPixels& pixels) {
  std::vector<int> depth(pixels.port.size(), 1);
  const int w = pixels.width, h = pixels.height;
  const auto next_to = [&](int x, int y, int other_x, int other_y) {
    if (other_x < 0 || other_x >= w || other_y < 0 || other_y >= h) return 1;
    const std::size_t here = std::size_t(y) * w + x, other = std::size_t(other_y) * w + other_x;
    return pixels.port[here] == pixels.port[other] ? depth[other] + 1 : 1;
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      depth[std::size_t(y) * w + x] = std::min(next_to(x, y, x - 1, y), next_to(x, y, x, y - 1));
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x)
      depth[std::size_t(y) * w + x] =
          std::min({depth[std::size_t(y) * w + x], next_to(x, y, x + 1, y), next_to(x, y, x, y + 1)});
  return depth;
}

}  // namespace

std::vector<SeenPort> seen_ports(const PortPixels& pixels, std::size_t n_ports) {
  struct Middle {
    double x = 0, y = 0, n = 0;
    int deepest = 0;
    double least = std::numeric_limits<double>::max();
  };
  std::vector<Middle> middle(n_ports);
  const auto depth = depths(pixels);
  const auto for_all = [&](auto&& what) {
    for (std::size_t i = 0; i < pixels.port.size(); ++i)
      if (const std::size_t port = pixels.port[i]; port > 0 && port <= n_ports)
        what(port - 1, depth[i], double(i % pixels.width), double(i / pixels.width));
  };
  for_all([&](std::size_t port, int deep, double x, double y) {
    auto& m = middle[port];
    m.x += x;
    m.y += y;
    m.n += 1;
    m.deepest = std::max(m.deepest, deep);
  });
  std::vector<SeenPort> seen(n_ports);
  for_all([&](std::size_t port, int deep, double x, double y) {
    auto& m = middle[port];
    const double away = std::hypot(x - m.x / m.n, y - m.y / m.n) + 0.9 * std::min(y, pixels.height - 1 - y);
    if (4 * deep < 3 * m.deepest || away >= m.least) return;
    m.least = away;
    seen[port] = {std::size_t(m.n), x, y};
  });
  return seen;
}

}  // namespace pipelines
