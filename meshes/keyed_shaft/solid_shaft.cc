#include "meshes/keyed_shaft/solid_shaft.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "meshes/checks/affordable.h"
#include "meshes/checks/curved_quality.h"
#include "meshes/checks/quality.h"
#include "meshes/checks/reentrant_edges.h"
#include "meshes/gmsh/gmsh_session.h"
#include "meshes/keyed_shaft/solid_layout.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/solids/cell_estimate.h"
#include "meshes/solids/model_mesh.h"
#include "meshes/solids/surface_pieces.h"
#include "meshes/values/constants.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

constexpr int volume_id = 1;

/// A feature and whether a point lies on it.
struct Surface {
  Feature feature;
  std::function<bool(const Point&)> holds;
};

class Surfaces {
public:
  Surfaces(const Shaft& shaft, const SolidLayout& layout, const std::vector<Keyway>& keyways)
      : shaft_(shaft), layout_(layout) {
    tolerance_m_ = 1e-6 * (layout.segments.back().end_m - layout.segments.front().begin_m);
    add_plane("end_1", Feature::Kind::end_face, layout.segments.front().begin_m);
    for (std::size_t i = 0; i < layout.segments.size(); ++i) {
      add_cylinder(i);
      if (i + 1 < layout.segments.size()) add_junction(i);
    }
    add_plane("end_2", Feature::Kind::end_face, layout.segments.back().end_m);
    if (layout.bore_radius_m > 0)
      for (std::size_t i = 0; i < layout.segments.size(); ++i)
        add_round("bore " + shaft.segments[i].name, Feature::Kind::bore, layout.segments[i].begin_m,
                  layout.segments[i].end_m, layout.bore_radius_m, 0, 0);
    for (const auto& keyway : keyways) add_keyway(keyway);
  }
  std::vector<Surface> all;

  int id_of(const std::string& name) const {
    for (const auto& surface : all)
      if (surface.feature.name == name) return surface.feature.boundary_id;
    throw std::logic_error("no surface " + name);
  }
  /// The first surface that holds all the points.
  int id_at(const std::vector<Point>& points) const {
    for (const auto& surface : all)
      if (std::all_of(points.begin(), points.end(), surface.holds)) return surface.feature.boundary_id;
    throw MeshRefused(
        "solid shaft: a surface of the solid near z = " + std::to_string(points.front()[2] * 1e3) +
        " mm belongs to no part of the drawing: change the keyways there");
  }

private:
  void add(const std::string& name, Feature::Kind kind, double begin_m, double end_m,
           const std::function<bool(const Point&)>& holds) {
    const int id = volume_id + 1 + int(all.size());
    all.push_back({{name, kind, id, begin_m, end_m}, [=, tolerance = tolerance_m_](const Point& p) {
                     return p[2] >= begin_m - tolerance && p[2] <= end_m + tolerance && holds(p);
                   }});
  }
  void add_plane(const std::string& name, Feature::Kind kind, double z_m) {
    add(name, kind, z_m, z_m, [](const Point&) { return true; });
  }
  void add_round(const std::string& name, Feature::Kind kind, double begin_m, double end_m, double radius_m,
                 double x_m, double y_m) {
    add(name, kind, begin_m, end_m, [=, tolerance = tolerance_m_](const Point& p) {
      return std::abs(std::hypot(p[0] - x_m, p[1] - y_m) - radius_m) < tolerance;
    });
  }
  void add_cylinder(std::size_t i) {
    const SolidSegment& s = layout_.segments[i];
    const std::string& name = shaft_.segments[i].name;
    const auto piece = [&](const std::string& its_name, Feature::Kind kind, double begin_m, double end_m) {
      add_round(its_name, kind, begin_m, end_m, s.radius_m, s.axis_x_m, s.axis_y_m);
    };
    if (s.zone_begin_m > s.bare_begin_m)
      piece(name + " rim 1", Feature::Kind::surface, s.bare_begin_m, s.zone_begin_m);
    piece(name, shaft_.segments[i].is_port ? Feature::Kind::seat : Feature::Kind::surface, s.zone_begin_m,
          s.zone_end_m);
    if (s.zone_end_m < s.bare_end_m)
      piece(name + " rim 2", Feature::Kind::surface, s.zone_end_m, s.bare_end_m);
  }
  void add_junction(std::size_t i) {
    const SolidSegment &left = layout_.segments[i], &right = layout_.segments[i + 1];
    const double fillet_m = layout_.fillets_m[i];
    if (left.radius_m == right.radius_m) return;
    const std::string pair = shaft_.segments[i].name + "/" + shaft_.segments[i + 1].name;
    const bool rises = left.radius_m < right.radius_m;
    const double small_m = std::min(left.radius_m, right.radius_m), z_m = left.end_m;
    if (fillet_m > 0) {
      const double centre_z_m = rises ? z_m - fillet_m : z_m + fillet_m;
      add("fillet " + pair, Feature::Kind::fillet, std::min(z_m, centre_z_m), std::max(z_m, centre_z_m),
          [=, tolerance = tolerance_m_](const Point& p) {
            const double outward = std::hypot(p[0], p[1]) - small_m - fillet_m;
            return std::abs(std::hypot(outward, p[2] - centre_z_m) - fillet_m) < tolerance;
          });
    }
    const bool eccentric = left.is_eccentric() || right.is_eccentric();
    if (eccentric || std::max(left.radius_m, right.radius_m) > small_m + fillet_m + tolerance_m_)
      add_plane("shoulder " + pair, Feature::Kind::shoulder, z_m);
  }
  void add_keyway(const Keyway& keyway) {
    std::string name = "keyway " + keyway.segment;
    for (int n = 2; std::any_of(all.begin(), all.end(), [&](auto& s) { return s.feature.name == name; }); ++n)
      name = "keyway " + keyway.segment + " " + std::to_string(n);
    const SolidSegment segment = layout_.segments[segment_of(keyway, shaft_)];
    add(name, Feature::Kind::surface, keyway.begin_m, keyway.begin_m + keyway.length_m,
        [=, tolerance = tolerance_m_](const Point& p) {
          const Point local = in_keyway(keyway, segment, p);
          return std::abs(local[0]) < keyway.width_m / 2 + tolerance &&
                 local[2] > segment.radius_m - keyway.depth_m - tolerance;
        });
  }

  const Shaft& shaft_;
  const SolidLayout& layout_;
  double tolerance_m_ = 0;
};

/// Gives every face the id of its surface.
void assign(const Surfaces& surfaces, ModelMesh& model) {
  std::vector<std::vector<Point>> points(model.pieces.size());
  for (std::size_t f = 0; f < model.mesh.n_faces(); ++f)
    for (std::size_t i = 0; i < model.mesh.corners_per_face(); ++i)
      points[model.mesh.face_id[f]].push_back(model.mesh.points[model.mesh.face(f)[i]]);
  std::vector<int> id_of_piece;
  for (const auto& of_piece : points) id_of_piece.push_back(surfaces.id_at(of_piece));
  for (int& id : model.mesh.face_id) id = id_of_piece[id];
  for (int& id : model.mesh.volume_id) id = volume_id;
}

std::vector<Port> ports_of(const Shaft& shaft, const SolidLayout& layout, const Surfaces& surfaces) {
  const SolidSegment &first = layout.segments.front(), &last = layout.segments.back();
  std::vector<Port> ports;
  ports.push_back({"end_1", Port::Kind::face, surfaces.id_of("end_1"), first.begin_m, first.begin_m,
                   first.radius_m, first.axis_x_m, first.axis_y_m});
  for (std::size_t i = 0; i < layout.segments.size(); ++i) {
    const SolidSegment& s = layout.segments[i];
    const ShaftSegment& from = shaft.segments[i];
    if (from.is_port)
      ports.push_back({from.name, Port::Kind::seat, surfaces.id_of(from.name), s.zone_begin_m, s.zone_end_m,
                       s.radius_m, s.axis_x_m, s.axis_y_m});
    if (!from.bore_port.empty())
      ports.push_back({from.bore_port, Port::Kind::bore, surfaces.id_of("bore " + from.name), s.begin_m,
                       s.end_m, layout.bore_radius_m, 0, 0});
  }
  ports.push_back({"end_2", Port::Kind::face, surfaces.id_of("end_2"), last.end_m, last.end_m, last.radius_m,
                   last.axis_x_m, last.axis_y_m});
  return ports;
}

/// Corners of shoulders without a fillet are left out as block meshes leave them out, so that a keyway
/// elsewhere does not change which stress is reported there.
/// @param rounding_m  rounding of coordinates along the axis; pieces of an edge leave its circle as cells do
void widen_at_shoulders(const SolidLayout& layout, double rounding_m, std::vector<SharpEdge>& edges) {
  constexpr double off_arc = 1e-3;
  for (std::size_t i = 0; i + 1 < layout.segments.size(); ++i) {
    const auto &before = layout.segments[i], &after = layout.segments[i + 1];
    if (layout.fillets_m[i] > 0) continue;
    const auto& small = before.radius_m < after.radius_m ? before : after;
    const auto is_on_corner = [&](const std::array<double, 3>& p) {
      const double r_m = std::hypot(p[0] - small.axis_x_m, p[1] - small.axis_y_m);
      return std::abs(p[2] - before.end_m) < rounding_m && std::abs(r_m - small.radius_m) < off_arc * r_m;
    };
    for (auto& edge : edges)
      if (std::all_of(edge.pieces.begin(), edge.pieces.end(),
                      [&](const auto& piece) { return is_on_corner(piece[0]) && is_on_corner(piece[1]); }))
        edge.distance_m = sharp_shoulder_distance_m(2 * small.radius_m);
  }
}

}  // namespace

void check_solid_shaft(const Shaft& shaft, const std::vector<Keyway>& keyways, const SolidControl& control) {
  check_control(control);
  check_shaft(shaft);
  check_keyways(shaft, lay_out_solid(shaft), keyways);
}

double estimated_cells(const Shaft& shaft, const SolidControl& control) {
  const double per_volume = 6 * std::sqrt(2.0), per_area = 3 * 4 / std::sqrt(3.0);  // as cell_estimate.cc
  const auto layout = lay_out_solid(shaft);
  double largest_m = 0, volume_m3 = 0;
  for (const auto& segment : layout.segments) {
    largest_m = std::max(largest_m, segment.radius_m);
    volume_m3 += pi * (std::pow(segment.radius_m, 2) - std::pow(layout.bore_radius_m, 2)) *
                 (segment.end_m - segment.begin_m);
  }
  const double length_m = layout.segments.back().end_m - layout.segments.front().begin_m;
  const double diagonal_m = std::hypot(length_m, 2 * std::sqrt(2.0) * largest_m);
  const double size_m = control.size_factor * (control.size_m > 0 ? control.size_m : diagonal_m / 20);
  double n_cells = per_volume * volume_m3 / std::pow(size_m, 3);
  const auto add = [&](double area_m2, double radius_m) {
    const double curved_m = std::max(control.smallest_size_m, 2 * pi * radius_m / control.cells_per_circle);
    n_cells += per_area * area_m2 / std::pow(std::min(size_m, curved_m), 2);
  };
  for (const auto& segment : layout.segments)
    add(2 * pi * segment.radius_m * (segment.end_m - segment.begin_m), segment.radius_m);
  if (layout.bore_radius_m > 0) add(2 * pi * layout.bore_radius_m * length_m, layout.bore_radius_m);
  for (std::size_t i = 0; i < layout.fillets_m.size(); ++i) {
    const double fillet_m = layout.fillets_m[i],
                 radius_m = std::min(layout.segments[i].radius_m, layout.segments[i + 1].radius_m);
    if (fillet_m > 0) add(pi / 2 * fillet_m * 2 * pi * (radius_m + fillet_m), fillet_m);
  }
  return n_cells;
}

BodyMesh build_solid_shaft(const Shaft& shaft, const std::vector<Keyway>& keyways,
                           const SolidControl& control) {
  check_solid_shaft(shaft, keyways, control);
  const SolidLayout layout = lay_out_solid(shaft);
  ModelMesh model;
  with_gmsh("meshing the shaft with keyways", [&] {
    model_solid(shaft, layout, keyways);
    require_affordable(estimated_cells(control, 1e-3), bytes_per_tetrahedron, control_of_cells(control),
                       "make the cells larger, or the fine parts fewer");
    model = mesh_and_collect(control, 1e-3);
  });
  const Surfaces surfaces(shaft, layout, keyways);
  assign(surfaces, model);
  BodyMesh body;
  body.groups.volumes[volume_id] = "shaft";
  for (const auto& surface : surfaces.all) {
    body.groups.boundaries[surface.feature.boundary_id] = surface.feature.name;
    body.features.push_back(surface.feature);
  }
  body.ports = ports_of(shaft, layout, surfaces);
  body.quality = measure_quality(model.mesh);
  require_quality(body.quality, least_scaled_jacobian(model, control), "mesh",
                  "make the cells smaller there, change the keyway, or lower min_scaled_jacobian");
  body.sharp_edges =
      reentrant_edges(model.mesh, body.groups.boundaries,
                      control.exclusion_m > 0 ? control.exclusion_m : usual_exclusion_m(model));
  if (control.exclusion_m == 0) widen_at_shoulders(layout, 1e-6 * diagonal_m(model.mesh), body.sharp_edges);
  body.straight_edges = std::move(model.straight_edges);
  body.cells = std::make_shared<const CellMesh>(std::move(model.mesh));
  return body;
}

}  // namespace meshes
