#include "meshes/fan.h"

#include <cmath>
#include <utility>

#include "meshes/grading.h"

namespace meshes {

namespace {

const double pi = std::acos(-1.0);

using Grid = std::vector<std::vector<int>>;

/// Radii of the big segment's rows from the top of the fillet (or of the small segment) to its surface.
std::vector<double> radii_above(const Junction& junction, const SegmentLayout& big) {
  const int n_used = junction.n_below + (junction.kind == Junction::Kind::fillet ? junction.n_half_arc : 0);
  const int n_inner = big.n_inner_rows - n_used;
  const double inner_top_m = big.is_eccentric() ? big.inner_radius_m : big.radius_m;
  const double first_m = 4 * junction.first_cell_m;
  std::vector<double> radii = {junction.top_radius_m};
  if (n_inner > 0)
    radii = spread(junction.top_radius_m, inner_top_m,
                   geometric_fractions(n_inner, first_m / (inner_top_m - junction.top_radius_m)));
  if (big.n_outer_rows > 0) {
    const auto outer = spread(inner_top_m, big.radius_m,
                              geometric_fractions(big.n_outer_rows, first_m / (big.radius_m - inner_top_m)));
    radii.insert(radii.end(), outer.begin() + 1, outer.end());
  }
  return radii;
}

/// Rows from the core up to `top`, finest at the top.
std::vector<double> radii_below(double core_m, double top_m, int n, double last_m) {
  const auto from_top = geometric_fractions(n, last_m / (top_m - core_m));
  std::vector<double> radii(n + 1);
  for (int k = 0; k <= n; ++k) radii[n - k] = top_m + (core_m - top_m) * from_top[k];
  radii.front() = core_m;
  return radii;
}

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

JunctionFaces build_sharp(BlockMesh& mesh, const ShaftLayout& layout, const Junction& junction,
                          const JunctionSurfaces& ids) {
  const auto below =
      radii_below(layout.core_radius_m, junction.small_radius_m, junction.n_below, junction.first_cell_m);
  const auto above = radii_above(junction, layout.segments[junction.big]);
  JunctionFaces faces;
  faces.small = mesh.add_line(junction.z_m, below);
  std::vector<int> shoulder = {faces.small.back()};
  for (std::size_t k = 1; k < above.size(); ++k) shoulder.push_back(mesh.add_point(junction.z_m, above[k]));
  add_edges(mesh, shoulder, ids.shoulder_id);
  faces.big = faces.small;
  faces.big.insert(faces.big.end(), shoulder.begin() + 1, shoulder.end());
  return faces;
}

JunctionFaces build_fan(BlockMesh& mesh, const ShaftLayout& layout, const Junction& junction,
                        const JunctionSurfaces& ids, const SurfaceTable& surfaces) {
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
  for (int i = 0; i <= n; ++i) floor.push_back(at(-f + (f + d) * i / n, floor_m));
  wall.push_back(floor.back());
  for (int i = 1; i <= n; ++i) wall.push_back(at(d, i == n ? top_m : floor_m + (top_m - floor_m) * i / n));

  const std::vector<int> lower_arc(arc.begin(), arc.begin() + n + 1), upper_arc(arc.begin() + n, arc.end());
  const Grid lower = ruled_block(mesh, lower_arc, floor, junction.depth_fractions, {});
  const Grid right = ruled_block(mesh, upper_arc, wall, junction.depth_fractions, lower.back());

  const double last_m = d * (1 - *(junction.depth_fractions.end() - 2));
  const auto below_radii = radii_below(layout.core_radius_m, floor_m, junction.n_below, last_m);
  Grid below;
  for (const int top : floor) {
    const double z_m = mesh.points[top].z_m;
    below.push_back(mesh.add_line(z_m, std::vector<double>(below_radii.begin(), below_radii.end() - 1)));
    below.back().push_back(top);
  }
  const auto above_radii = radii_above(junction, layout.segments[junction.big]);
  Grid above;
  for (const int bottom : right.back()) {
    above.push_back({bottom});
    for (std::size_t k = 1; k < above_radii.size(); ++k)
      above.back().push_back(mesh.add_point(mesh.points[bottom].z_m, above_radii[k]));
  }

  add_quads(mesh, lower, junction.small);
  add_quads(mesh, right, junction.big);
  add_quads(mesh, below, junction.small);
  add_quads(mesh, above, junction.big);
  add_edges(mesh, arc, ids.fillet_id);
  add_edges(mesh, above.front(), ids.shoulder_id);
  for (std::size_t j = 0; j + 1 < above.size(); ++j) {
    const int a = above[j].back(), b = above[j + 1].back();
    const double middle_m = 0.5 * (mesh.points[a].z_m + mesh.points[b].z_m);
    mesh.edges.push_back({{a, b}, surfaces.cylinder_at(junction.big, middle_m)});
  }

  JunctionFaces faces;
  faces.small = below.front();
  faces.small.insert(faces.small.end(), lower.front().rbegin() + 1, lower.front().rend());
  faces.big = below.back();
  faces.big.insert(faces.big.end(), wall.begin() + 1, wall.end());
  faces.big.insert(faces.big.end(), above.back().begin() + 1, above.back().end());
  return faces;
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

std::vector<double> spread(double from, double to, const std::vector<double>& fractions) {
  std::vector<double> values;
  for (const double x : fractions) values.push_back(from + (to - from) * x);
  values.front() = from;
  values.back() = to;
  return values;
}

JunctionFaces build_junction(BlockMesh& mesh, const ShaftLayout& layout, int left,
                             const SurfaceTable& surfaces) {
  const Junction& junction = layout.junctions[left];
  return junction.kind == Junction::Kind::sharp
             ? build_sharp(mesh, layout, junction, surfaces.junctions[left])
             : build_fan(mesh, layout, junction, surfaces.junctions[left], surfaces);
}

}  // namespace meshes
