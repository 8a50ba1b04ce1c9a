#include "fem/models/axisymmetric/revolved_nodes.h"

#include <array>
#include <cmath>

#include "fem/base/values/constants.h"

namespace fem {
namespace {

/// Corners counter-clockwise in (z, r); of a triangle the last one is the first again.
using Corners = std::array<int, 4>;

std::vector<Corners> corners_of(const ResultPolygon& polygon) {
  const auto& p = polygon.points;
  if (polygon.centre < 0) return {{p[0], p[1], p[2], p[3]}};
  std::vector<Corners> triangles;
  for (std::size_t i = 0; i < p.size(); ++i)
    triangles.push_back({polygon.centre, p[i], p[(i + 1) % p.size()], polygon.centre});
  return triangles;
}

class Revolution {
public:
  Revolution(const MeridianGrid& grid, int n_angles) : grid_(grid), n_angles_(n_angles) {
    auto& nodes = result_.nodes;
    nodes.degree = 1;
    for (const auto& p : grid.results) {
      result_.first.push_back(nodes.n);
      const int n = p.on_axis() ? 1 : n_angles;
      for (int j = 0; j < n; ++j) {
        const double angle = 2 * pi * j / n_angles;
        nodes.xyz_m.insert(nodes.xyz_m.end(), {p.r_m * std::cos(angle), p.r_m * std::sin(angle), p.z_m});
      }
      nodes.n += std::size_t(n);
    }
    result_.first.push_back(nodes.n);
    nodes.volume_m3.assign(nodes.n, 0);
    for (const auto& polygon : grid.polygons) add(polygon);
    for (const auto& edge : grid.edges) add(edge);
  }
  RevolvedNodes result() && { return std::move(result_); }

private:
  std::int32_t node(int point, int j) const {
    const std::size_t first = result_.first[std::size_t(point)];
    return std::int32_t(grid_.results[std::size_t(point)].on_axis() ? first
                                                                    : first + std::size_t(j % n_angles_));
  }

  /// Moment about the axis of the corners' shape functions on a triangle, added to the share of each.
  void add_triangle(const std::array<int, 3>& corners, std::vector<std::pair<int, double>>& shares) const {
    const auto at = [&](int i) -> const ResultPoint& { return grid_.results[std::size_t(corners[i])]; };
    const double area = 0.5 * ((at(1).z_m - at(0).z_m) * (at(2).r_m - at(0).r_m) -
                               (at(2).z_m - at(0).z_m) * (at(1).r_m - at(0).r_m));
    const double sum_r = at(0).r_m + at(1).r_m + at(2).r_m;
    for (int i = 0; i < 3; ++i) shares.emplace_back(corners[i], area * (sum_r + at(i).r_m) / 12);
  }

  void add(const ResultPolygon& polygon) {
    auto& nodes = result_.nodes;
    std::vector<std::pair<int, double>> shares;
    for (const auto& c : corners_of(polygon)) {
      add_triangle({c[0], c[1], c[2]}, shares);
      if (c[3] != c[0]) add_triangle({c[0], c[2], c[3]}, shares);
      for (int j = 0; j < n_angles_; ++j) {
        for (int k = 0; k < 2; ++k)
          for (const int corner : c) nodes.cells.push_back(node(corner, j + k));
        nodes.cell_volume_id.push_back(0);
      }
    }
    double sum = 0;
    for (const auto& [point, share] : shares) sum += share;
    for (const auto& [point, share] : shares) {
      const auto p = std::size_t(point);
      for (std::size_t i = result_.first[p]; i < result_.first[p + 1]; ++i)
        nodes.volume_m3[i] += share / sum * polygon.volume_m3 / double(result_.n_at(p));
    }
  }

  void add(const SurfaceEdge& edge) {
    auto& nodes = result_.nodes;
    for (std::size_t half = 0; half < 2; ++half) {
      const int a = edge.result_points[half], b = edge.result_points[half + 1];
      for (int j = 0; j < n_angles_; ++j) {
        nodes.faces.insert(nodes.faces.end(), {node(a, j), node(b, j), node(b, j + 1), node(a, j + 1)});
        nodes.face_boundary_id.push_back(edge.boundary_id);
      }
    }
  }

  const MeridianGrid& grid_;
  int n_angles_;
  RevolvedNodes result_;
};

}  // namespace

RevolvedNodes revolve(const MeridianGrid& grid, int n_angles) {
  return Revolution(grid, n_angles).result();
}

}  // namespace fem
