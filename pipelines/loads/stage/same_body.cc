#include "pipelines/loads/stage/same_body.h"

#include <algorithm>
#include <tuple>

#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/body_reader.h"

namespace pipelines {
namespace {

// Each tuple has every field of its struct: one that is left out would let two bodies share a mesh that
// differ. The test SweptBodies.EveryKeyOfABodyMakesAnother holds that.

auto fields(const meshes::ShaftSegment& s) {
  return std::tie(s.name, s.begin_m, s.end_m, s.diameter_m, s.eccentricity_m, s.is_port,
                  s.eccentricity_angle_rad, s.bore_m, s.bore_port);
}

auto fields(const meshes::ShaftMeshControl& c) {
  return std::tie(c.cells_per_fillet_quarter, c.fillet_cells, c.n_sectors, c.growth, c.largest_cell_m,
                  c.axial_share, c.rows_factor, c.min_scaled_jacobian, c.subdivisions, c.lean);
}

auto fields(const meshes::Keyway& k) {
  return std::tie(k.segment, k.width_m, k.depth_m, k.length_m, k.begin_m, k.angle_rad, k.round_ends);
}

auto fields(const meshes::FineSpot& s) {
  return std::tie(s.centre_m, s.radius_m, s.size_m);
}

auto fields(const meshes::FineToe& t) {
  return std::tie(t.at_m, t.walls);
}

auto fields(const meshes::ChamberFoot& f) {
  return std::tie(f.x_m, f.y_m);
}

auto fields(const meshes::GroupSelection& g) {
  return std::tie(g.name);
}

auto fields(const meshes::BoxSelection& b) {
  return std::tie(b.low_m, b.high_m);
}

auto fields(const meshes::CylinderSelection& c) {
  return std::tie(c.axis_x_m, c.axis_y_m, c.radius_m, c.begin_m, c.end_m, c.side);
}

template <typename T>
bool are_same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return fields(x) == fields(y); });
}

bool are_same(const meshes::SolidControl& a, const meshes::SolidControl& b) {
  const auto plain = [](const meshes::SolidControl& c) {
    return std::tie(c.size_m, c.size_factor, c.smallest_size_m, c.cells_per_circle, c.min_scaled_jacobian,
                    c.exclusion_m);
  };
  return plain(a) == plain(b) && are_same(a.fine_spots, b.fine_spots);
}

bool are_same(const ShaftShape& a, const ShaftShape& b) {
  return are_same(a.geometry.segments, b.geometry.segments) && a.geometry.fillets_m == b.geometry.fillets_m &&
         fields(a.mesh) == fields(b.mesh) && are_same(a.keyways, b.keyways) && are_same(a.solid, b.solid);
}

auto fields(const meshes::Chamber& c) {
  return std::tie(c.tube.inner_radius_m, c.tube.wall_m, c.tube.length_m, c.tube.axis_x_m, c.tube.axis_y_m,
                  c.flanges.outer_radius_m, c.flanges.thickness_m, c.housing.outer_radius_m,
                  c.housing.bore_radius_m, c.housing.length_m, c.webs.thickness_m, c.webs.height_m,
                  c.webs.z_m, c.lugs.thickness_m, c.lugs.width_m, c.lugs.z_m, c.pads.size_x_m,
                  c.pads.size_y_m, c.pads.size_z_m);
}

bool are_same(const ChamberShape& a, const ChamberShape& b) {
  const auto control = [](const meshes::ChamberMeshControl& c) {
    return std::tie(c.cells_through_wall, c.size_m, c.growth, c.toe_walls, c.min_scaled_jacobian, c.lean);
  };
  return fields(a.geometry) == fields(b.geometry) && are_same(a.geometry.feet, b.geometry.feet) &&
         control(a.mesh) == control(b.mesh) && are_same(a.mesh.fine_toes, b.mesh.fine_toes);
}

struct SameSelection {
  template <typename A, typename B>
  bool operator()(const A&, const B&) const {
    return false;
  }
  template <typename A>
  bool operator()(const A& a, const A& b) const {
    return fields(a) == fields(b);
  }
};

bool are_same(const meshes::Import& a, const meshes::Import& b) {
  const auto same_port = [](const meshes::ImportPort& p, const meshes::ImportPort& q) {
    return std::tie(p.name, p.kind) == std::tie(q.name, q.kind) &&
           std::visit(SameSelection{}, p.selection, q.selection);
  };
  return std::tie(a.geometry, a.scale_to_m, a.time_limit_s) ==
             std::tie(b.geometry, b.scale_to_m, b.time_limit_s) &&
         are_same(a.control, b.control) &&
         std::equal(a.ports.begin(), a.ports.end(), b.ports.begin(), b.ports.end(), same_port);
}

struct SameShape {
  template <typename A, typename B>
  bool operator()(const A&, const B&) const {
    return false;
  }
  template <typename A>
  bool operator()(const A& a, const A& b) const {
    return are_same(a, b);
  }
};

}  // namespace

bool have_one_mesh(const BodyScene& a, const BodyScene& b) {
  return std::tie(a.name, a.degree, a.refinements) == std::tie(b.name, b.degree, b.refinements) &&
         std::visit(SameShape{}, a.shape, b.shape);
}

bool have_one_stiffness(const Scene& a, const Scene& b, std::size_t i) {
  const auto material = [](const fem::Material& m) {
    return std::tie(m.youngs_modulus_Pa, m.poisson_ratio, m.density_kg_m3);
  };
  const BodyScene &first = a.bodies[i], &second = b.bodies[i];
  if (material(first.material) != material(second.material) || first.solver != second.solver) return false;
  const bool elastic = reader_of(first).has_elastic_feet(first);
  if (elastic != reader_of(second).has_elastic_feet(second)) return false;
  if (!elastic) return true;
  const auto these = springs_of(a), those = springs_of(b);
  return std::equal(these.begin(), these.end(), those.begin(), those.end(),
                    [](const auto& s, const auto& t) { return s.stiffness_N_m == t.stiffness_N_m; });
}

}  // namespace pipelines
