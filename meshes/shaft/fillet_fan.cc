#include "meshes/shaft/fillet_fan.h"

#include <cmath>
#include <utility>

#include "meshes/values/constants.h"

namespace meshes {

namespace {

using Grid = std::vector<std::vector<int>>;

/// Ruled block from the line `arc` to the line `outer`; the first and last rays may exist already.
Grid ruled_block(BlockMesh& mesh, const std::vector<int>& arc, const std::vector<int>& outer,
                 const std::vector<double>& fractions, const std::vector<int>& first_ray) {
  Grid grid(arc.size());
  for (std::size_t i = 0; i < arc.size(); ++i) {
    if (i == 0 && !first_ray.empty()) {
      grid[i] = first_ray;
      continue;
    }
    const MeridianPoint from = mesh.points[arc[i]], to = mesh.points[outer[i]];
    grid[i].push_back(arc[i]);
    for (std::size_t j = 1; j + 1 < fractions.size(); ++j)
      grid[i].push_back(mesh.add_point(from.z_m + (to.z_m - from.z_m) * fractions[j],
                                       from.r_m + (to.r_m - from.r_m) * fractions[j]));
    grid[i].push_back(outer[i]);
  }
  return grid;
}

void add_quads(BlockMesh& mesh, const Grid& grid, int segment) {
  for (std::size_t i = 0; i + 1 < grid.size(); ++i)
    for (std::size_t j = 0; j + 1 < grid[i].size(); ++j)
      mesh.add_quad({grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]}, segment);
}

void add_edges(BlockMesh& mesh, const std::vector<int>& line, int boundary_id) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    mesh.edges.push_back({{line[i], line[i + 1]}, boundary_id});
}

/// One plane: the rows that both segments share, the shoulder above them, the face of a bore step below.
JunctionFaces build_plane(BlockMesh& mesh, const ShaftLayout& layout, const Junction& junction,
                          const JunctionSurfaces& ids, const PlaneRadii& radii) {
  const std::vector<int> below = mesh.add_line(junction.z_m, radii.below);
  std::vector<int> shoulder = {below.back()};
  for (std::size_t k = 1; k < radii.above.size(); ++k)
    shoulder.push_back(mesh.add_point(junction.z_m, radii.above[k]));
  add_edges(mesh, shoulder, ids.shoulder_id);

  std::vector<int> small = below, big = below;
  big.insert(big.end(), shoulder.begin() + 1, shoulder.end());
  if (junction.is_bore_step) {
    const int n_low = rows_below_step(layout, junction);
    add_edges(mesh, {below.begin(), below.begin() + n_low + 1}, ids.step_id);
    std::vector<int>& wide = junction.wide == junction.small ? small : big;
    wide.erase(wide.begin(), wide.begin() + n_low);
  }
  return junction.direction > 0 ? JunctionFaces{small, big} : JunctionFaces{big, small};
}

JunctionFaces build_fan(BlockMesh& mesh, const ShaftLayout& layout, const Junction& junction,
                        const JunctionSurfaces& ids, const PlaneRadii& radii, const SurfaceTable& surfaces) {
  const int n = junction.n_half_arc;
  const double f = junction.fillet_m, d = junction.depth_m;
  const double foot_m = junction.small_radius_m, top_m = junction.top_radius_m, floor_m = foot_m - d;
  const auto at = [&](double t, double r_m) {
    return mesh.add_point(junction.z_m + junction.direction * t, r_m);
  };

  std::vector<int> arc;
  for (int i = 0; i <= 2 * n; ++i) {
    const double angle = 0.25 * pi * i / n;  // from the foot on the small cylinder
    const double t = i == 2 * n ? 0 : f * (std::sin(angle) - 1);
    arc.push_back(at(t, i == 2 * n ? top_m : foot_m + f * (1 - std::cos(angle))));
  }
  std::vector<int> floor, wall;
  const int n_before = junction.n_floor_before_plane;
  for (int i = 0; i <= n; ++i) {
    const double t = n_before == 0  ? -f + (f + d) * i / n
                     : i < n_before ? -f + f * i / n_before
                                    : d * (i - n_before) / (n - n_before);
    floor.push_back(at(t, floor_m));
  }
  wall.push_back(floor.back());
  for (int i = 1; i <= n; ++i) wall.push_back(at(d, i == n ? top_m : floor_m + (top_m - floor_m) * i / n));

  const std::vector<int> lower_arc(arc.begin(), arc.begin() + n + 1), upper_arc(arc.begin() + n, arc.end());
  const Grid lower = ruled_block(mesh, lower_arc, floor, junction.depth_fractions, {});
  const Grid right = ruled_block(mesh, upper_arc, wall, junction.depth_fractions, lower.back());

  Grid below;
  for (const int top : floor) {
    const double z_m = mesh.points[top].z_m;
    below.push_back(mesh.add_line(z_m, Radii(radii.below.begin(), radii.below.end() - 1)));
    below.back().push_back(top);
  }
  Grid above;
  for (const int bottom : right.back()) {
    above.push_back({bottom});
    for (std::size_t k = 1; k < radii.above.size(); ++k)
      above.back().push_back(mesh.add_point(mesh.points[bottom].z_m, radii.above[k]));
  }

  add_quads(mesh, lower, junction.small);
  add_quads(mesh, right, junction.big);
  add_quads(mesh, below, junction.small);
  add_quads(mesh, above, junction.big);
  add_edges(mesh, arc, ids.fillet_id);
  add_edges(mesh, above.front(), ids.shoulder_id);
  const auto middle_m = [&](int a, int b) { return 0.5 * (mesh.points[a].z_m + mesh.points[b].z_m); };
  for (std::size_t j = 0; j + 1 < above.size(); ++j) {
    const int a = above[j].back(), b = above[j + 1].back();
    mesh.edges.push_back({{a, b}, surfaces.cylinder_at(junction.big, middle_m(a, b))});
  }
  if (layout.segments[junction.small].is_bored())
    for (std::size_t j = 0; j + 1 < below.size(); ++j) {
      const int a = below[j].front(), b = below[j + 1].front();
      const bool in_big = junction.direction * (middle_m(a, b) - junction.bore_border_m) > 0;
      mesh.edges.push_back({{a, b}, surfaces.bore_ids[in_big ? junction.big : junction.small]});
    }

  std::vector<int> small = below.front(), big = below.back();
  small.insert(small.end(), lower.front().rbegin() + 1, lower.front().rend());
  big.insert(big.end(), wall.begin() + 1, wall.end());
  big.insert(big.end(), above.back().begin() + 1, above.back().end());
  return junction.direction > 0 ? JunctionFaces{small, big} : JunctionFaces{big, small};
}

}  // namespace

int BlockMesh::add_point(double z_m, double r_m) {
  points.push_back({z_m, r_m});
  return static_cast<int>(points.size()) - 1;
}

std::vector<int> BlockMesh::add_line(double z_m, const std::vector<double>& radii_m) {
  std::vector<int> line;
  for (const double r_m : radii_m) line.push_back(add_point(z_m, r_m));
  return line;
}

void BlockMesh::add_quad(std::array<int, 4> corners, int segment) {
  double twice_area = 0;
  for (int i = 0; i < 4; ++i) {
    const MeridianPoint& a = points[corners[i]];
    const MeridianPoint& b = points[corners[(i + 1) % 4]];
    twice_area += a.z_m * b.r_m - b.z_m * a.r_m;
  }
  if (twice_area < 0) std::swap(corners[1], corners[3]);
  quads.push_back({corners, segment});
}

JunctionFaces build_junction(BlockMesh& mesh, const ShaftLayout& layout, const RadiiPlan& plan, int left,
                             const SurfaceTable& surfaces) {
  const Junction& junction = layout.junctions[left];
  const JunctionSurfaces& ids = surfaces.junctions[left];
  return junction.has_fan() ? build_fan(mesh, layout, junction, ids, plan.planes[left], surfaces)
                            : build_plane(mesh, layout, junction, ids, plan.planes[left]);
}

}  // namespace meshes
