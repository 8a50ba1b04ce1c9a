#include "meshes/shaft/meridian.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "meshes/shaft/fillet_fan.h"
#include "meshes/shaft/row_radii.h"
#include "meshes/spacing/grading.h"
#include "meshes/values/constants.h"

namespace meshes {

namespace {

// First cell beside the foot of a fillet, in cells of the arc: at 3 the stress recovered at the foot of a
// small fillet suffers from the jump in size, below 2.5 nothing is gained.
const double cell_at_foot = 2.5;
// A thin shell bends within sqrt(radius times wall) of its end: cells grow half as fast there.
const double growth_in_shells = 0.5;

/// The two faces of each segment's column, from the base outwards.
struct Faces {
  std::vector<int> begin, end;
};

/// Three times the size around; where the wall is thin, four walls at 16 sectors, but no less than the size
/// around.
double usual_cell(const SegmentLayout& segment, int n_sectors) {
  const double size_m = 6 * pi * segment.radius_m / n_sectors;
  if (!segment.is_bored()) return size_m;
  return std::min(size_m, std::max(2 * pi * segment.radius_m, 64 * segment.wall_m()) / n_sectors);
}

}  // namespace

AxialSize axial_size(const ShaftLayout& layout, int index, const ShaftMeshControl& control) {
  const SegmentLayout& segment = layout.segments[index];
  AxialSize size;
  const double chosen_m = usual_cell(segment, control.n_sectors);
  const bool is_thin = chosen_m < 6 * pi * segment.radius_m / control.n_sectors;
  size.growth = is_thin ? growth_in_shells * control.growth : control.growth;
  size.largest_m = control.largest_cell_m > 0 ? control.largest_cell_m : control.axial_share * chosen_m;
  for (const Junction& junction : layout.junctions) {
    if (junction.is_bore_step && (junction.small == index || junction.big == index))
      size.sources.push_back({junction.z_m, junction.step_cell_m});
    if (junction.kind == Junction::Kind::flush) continue;
    const bool towards_end = junction.z_m > 0.5 * (segment.begin_m + segment.end_m);
    const double z_m = towards_end ? segment.column_end_m : segment.column_begin_m;
    if (junction.kind == Junction::Kind::sharp && (junction.small == index || junction.big == index))
      size.sources.push_back({z_m, junction.first_cell_m});
    else if (junction.small == index)
      size.sources.push_back({z_m, cell_at_foot * junction.first_cell_m});
    else if (junction.big == index)
      size.sources.push_back({z_m, junction.depth_m * (1 - *(junction.depth_fractions.end() - 2))});
  }
  return size;
}

namespace {

/// Where a cell boundary must lie inside the column: the limits of the loaded zone and its centre, where the
/// seat's deflection and slope are told; the middle of other segments, if the part at least half a diameter
/// from both ends is shorter than the largest cell, so that it might get no boundary of its own.
std::vector<double> breaks_of(const SegmentLayout& segment, double largest_m) {
  std::vector<double> breaks = {segment.column_begin_m};
  const double tiny_m = 1e-9 * segment.radius_m;
  const auto add = [&](double z_m) {
    if (z_m > breaks.back() + tiny_m && z_m < segment.column_end_m - tiny_m) breaks.push_back(z_m);
  };
  const double length_m = segment.end_m - segment.begin_m;
  if (segment.is_port) add(segment.zone_begin_m);
  const double plain_m = length_m - 2 * segment.radius_m;
  if (segment.is_port || (plain_m >= -tiny_m && plain_m <= largest_m))
    add(0.5 * (segment.begin_m + segment.end_m));  // a loaded zone is centred in its segment
  if (segment.is_port) add(segment.zone_end_m);
  breaks.push_back(segment.column_end_m);
  return breaks;
}

std::vector<double> column_stations(const ShaftLayout& layout, int index, const ShaftMeshControl& control) {
  const AxialSize size = axial_size(layout, index, control);
  const SegmentLayout& segment = layout.segments[index];
  const std::vector<double> breaks = breaks_of(segment, size.largest_m);
  const double column_m = breaks.back() - breaks.front();
  std::vector<double> stations = {breaks.front()};
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const int n_usual = control.is_cut_later() ? 2 : 4;
    const int n_wanted = segment.is_short() && !segment.is_port ? 1 : n_usual;
    const int n_min = static_cast<int>(std::ceil(n_wanted * (breaks[i] - breaks[i - 1]) / column_m - 0.5));
    const auto piece =
        axial_stations(breaks[i - 1], breaks[i], size, std::max(1, n_min), control.subdivisions);
    stations.insert(stations.end(), piece.begin() + 1, piece.end());
  }
  return stations;
}

/// Cells between the two faces of a column: rows run straight from one face to the other.
void fill_column(BlockMesh& mesh, const Faces& faces, const std::vector<double>& stations, int segment,
                 const SurfaceTable& surfaces) {
  const std::size_t n_rows = faces.begin.size() - 1;
  const double begin_m = stations.front(), length_m = stations.back() - begin_m;
  std::vector<int> previous = faces.begin;
  for (std::size_t i = 1; i < stations.size(); ++i) {
    std::vector<int> next = faces.end;
    if (i + 1 < stations.size())
      for (std::size_t k = 0; k <= n_rows; ++k) {
        const double from_m = mesh.points[faces.begin[k]].r_m, to_m = mesh.points[faces.end[k]].r_m;
        next[k] =
            mesh.add_point(stations[i], from_m + (to_m - from_m) * ((stations[i] - begin_m) / length_m));
      }
    for (std::size_t k = 0; k < n_rows; ++k)
      mesh.add_quad({previous[k], next[k], next[k + 1], previous[k + 1]}, segment);
    const double middle_m = 0.5 * (stations[i - 1] + stations[i]);
    mesh.edges.push_back({{previous.back(), next.back()}, surfaces.cylinder_at(segment, middle_m)});
    if (surfaces.bore_ids[segment] != 0)
      mesh.edges.push_back({{previous.front(), next.front()}, surfaces.bore_ids[segment]});
    previous = std::move(next);
  }
}

void add_end_edges(BlockMesh& mesh, const std::vector<int>& face, int boundary_id) {
  for (std::size_t k = 0; k + 1 < face.size(); ++k)
    mesh.edges.push_back({{face[k], face[k + 1]}, boundary_id});
}

/// Turns each edge so that the material lies on its left.
void orient_edges(BlockMesh& mesh) {
  std::set<std::array<int, 2>> sides;
  for (const MeridianQuad& quad : mesh.quads)
    for (int i = 0; i < 4; ++i) sides.insert({quad.corners[i], quad.corners[(i + 1) % 4]});
  for (MeridianEdge& edge : mesh.edges)
    if (sides.count(edge.ends) == 0) std::swap(edge.ends[0], edge.ends[1]);
}

/// A core line for every run of solid segments.
std::vector<CoreLine> core_lines(const BlockMesh& mesh, const ShaftLayout& layout,
                                 const SurfaceTable& surfaces) {
  const auto n = static_cast<int>(layout.segments.size());
  std::vector<int> run_of(n, -1);
  std::vector<CoreLine> cores;
  for (int i = 0; i < n; ++i) {
    const SegmentLayout& segment = layout.segments[i];
    if (segment.is_bored()) continue;
    if (i == 0 || run_of[i - 1] < 0)
      cores.push_back(
          {{}, segment.base_radius_m, i == 0 ? surfaces.end_1_id : surfaces.junctions[i - 1].step_id, 0});
    cores.back().end_id = i + 1 == n ? surfaces.end_2_id : surfaces.junctions[i].step_id;
    run_of[i] = static_cast<int>(cores.size()) - 1;
  }
  std::vector<std::set<int>> points(cores.size());
  for (const MeridianQuad& quad : mesh.quads)
    if (run_of[quad.segment] >= 0)
      for (const int i : quad.corners)
        if (mesh.points[i].r_m == cores[run_of[quad.segment]].radius_m)
          points[run_of[quad.segment]].insert(i);
  for (std::size_t k = 0; k < cores.size(); ++k) {
    cores[k].points.assign(points[k].begin(), points[k].end());
    std::sort(cores[k].points.begin(), cores[k].points.end(),
              [&](int a, int b) { return mesh.points[a].z_m < mesh.points[b].z_m; });
  }
  return cores;
}

}  // namespace

Meridian build_meridian(const ShaftLayout& layout, const SurfaceTable& surfaces,
                        const ShaftMeshControl& control) {
  const auto n = static_cast<int>(layout.segments.size());
  const RadiiPlan plan = subdivided(plan_radii(layout), control.subdivisions);
  const ShaftLayout fine = subdivided(layout, control.subdivisions);
  BlockMesh mesh;
  std::vector<Faces> faces(n);
  faces.front().begin = mesh.add_line(layout.segments.front().begin_m, plan.first);
  for (int i = 0; i + 1 < n; ++i) {
    JunctionFaces built = build_junction(mesh, fine, plan, i, surfaces);
    faces[i].end = std::move(built.left);
    faces[i + 1].begin = std::move(built.right);
  }
  faces.back().end = mesh.add_line(layout.segments.back().end_m, plan.last);

  Meridian meridian;
  for (int i = 0; i < n; ++i) {
    const std::vector<double> stations = column_stations(layout, i, control);
    fill_column(mesh, faces[i], stations, i, surfaces);
    const bool begins_flush = i > 0 && layout.junctions[i - 1].kind == Junction::Kind::flush &&
                              !layout.junctions[i - 1].is_bore_step;
    const bool begins_in_fan = i > 0 && layout.junctions[i - 1].has_fan();
    const bool ends_in_fan = i + 1 < n && layout.junctions[i].has_fan();
    const std::size_t from = begins_flush || begins_in_fan ? 0 : 1;
    const std::size_t to = stations.size() - (ends_in_fan ? 0 : 1);
    for (std::size_t k = from; k < to; ++k) meridian.stations.push_back({stations[k], i});
  }
  add_end_edges(mesh, faces.front().begin, surfaces.end_1_id);
  add_end_edges(mesh, faces.back().end, surfaces.end_2_id);
  orient_edges(mesh);

  meridian.cores = core_lines(mesh, layout, surfaces);
  meridian.points = std::move(mesh.points);
  meridian.quads = std::move(mesh.quads);
  meridian.edges = std::move(mesh.edges);
  return meridian;
}

}  // namespace meshes
