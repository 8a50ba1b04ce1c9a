#include "pipelines/search/cheap_models/chamber_tube.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/models/beam/plated_tube.h"
#include "meshes/chamber/chamber_layout.h"

namespace pipelines {
namespace {

/// Force, and moment about the tube's axis.
using Push = std::array<double, fem::n_plate_loads>;

/// Mass that a plate carries: its integrals about the origin.
struct Weight {
  double mass_kg = 0, x_kg_m = 0, y_kg_m = 0, polar_kg_m2 = 0;

  void add(double mass, const meshes::PlanePoint& centre) {
    mass_kg += mass;
    x_kg_m += mass * centre[0];
    y_kg_m += mass * centre[1];
    polar_kg_m2 += mass * (centre[0] * centre[0] + centre[1] * centre[1]);
  }
};

/// One plate, and what is on it.
struct Plate {
  fem::TubePlate shape;
  std::string port;        ///< "housing_bore", "spring_foot_1"
  double share = 0;        ///< of what enters there
  Weight own, of_exciter;  ///< with its pad; its share of the housing
};

class Plates {
public:
  Plates(const BodyScene& body, const MeshedBody& meshed)
      : chamber_(std::get<ChamberShape>(body.shape).geometry), body_(body), meshed_(meshed) {
    const auto layout = meshes::lay_out(chamber_, std::get<ChamberShape>(body.shape).mesh);
    tube.outer_radius_m = layout.tube_outer_m;
    tube.wall_m = chamber_.tube.wall_m;
    tube.begin_m = -layout.flange_begin_m;
    tube.end_m = layout.flange_begin_m;
    tube.material = body.material;
    const std::size_t n_webs = chamber_.webs.z_m.size();
    for (std::size_t i = 0; i < layout.plates.size(); ++i) {
      const auto& plate = layout.plates[i];
      const double z_m = (plate.begin_m + plate.end_m) / 2;
      if (std::abs(z_m) >= layout.flange_begin_m) continue;  // the flange takes it
      Plate one = i < n_webs ? web(n_webs) : lug((i - n_webs) / 2);
      one.shape = {(plate.first_rad + plate.last_rad) / 2, (plate.last_rad - plate.first_rad) / 2, z_m,
                   plate.end_m - plate.begin_m};
      tube.plates.push_back(one.shape);
      plates_.push_back(one);
    }
  }

  /// What a unit load pushes a plate with.
  Push push(const fem::UnitLoad& load, std::size_t plate) const {
    if (const auto* force = std::get_if<fem::BodyForce>(&load.shape)) return push(*force, plates_[plate]);
    if (const auto* at_port = std::get_if<fem::SurfaceResultant>(&load.shape))
      return push(*at_port, plates_[plate]);
    return {};
  }

  fem::PlatedTube tube;

private:
  meshes::PlanePoint axis() const { return {chamber_.tube.axis_x_m, chamber_.tube.axis_y_m}; }

  /// Between the tube's outside and a part of the given size about a point, as long as it is wide or not.
  Weight plate_between(const meshes::PlanePoint& point, double size_m, double section_m2) const {
    const auto c = axis();
    const double distance_m = std::hypot(point[0] - c[0], point[1] - c[1]);
    const double length_m = std::max(0.0, distance_m - size_m - tube.outer_radius_m);
    const double middle = (tube.outer_radius_m + length_m / 2) / distance_m;
    Weight weight;
    weight.add(body_.material.density_kg_m3 * section_m2 * length_m,
               {c[0] + middle * (point[0] - c[0]), c[1] + middle * (point[1] - c[1])});
    return weight;
  }

  Plate web(std::size_t n_webs) const {
    Plate plate;
    plate.port = "housing_bore";
    plate.share = 1.0 / double(n_webs);
    plate.own = plate_between({0, 0}, chamber_.housing.outer_radius_m,
                              chamber_.webs.thickness_m * chamber_.webs.height_m);
    for (const auto& region : meshed_.regions)
      if (region.name == "exciter") {
        const auto& m = region.masses;
        plate.of_exciter = {plate.share * m.mass_kg, plate.share * m.first_moment_kg_m[0],
                            plate.share * m.first_moment_kg_m[1],
                            plate.share * (m.second_moments_kg_m2[0] + m.second_moments_kg_m2[1])};
      }
    return plate;
  }

  Plate lug(std::size_t foot) const {
    const auto& pads = chamber_.pads;
    const meshes::PlanePoint at{chamber_.feet[foot].x_m, chamber_.feet[foot].y_m};
    Plate plate;
    plate.port = "spring_foot_" + std::to_string(foot + 1);
    plate.share = 0.5;
    plate.own = plate_between(at, std::min(pads.size_x_m, pads.size_y_m) / 2,
                              chamber_.lugs.thickness_m * chamber_.lugs.width_m);
    plate.own.add(body_.material.density_kg_m3 * pads.size_x_m * pads.size_y_m * pads.size_z_m, at);
    return plate;
  }

  Push about_axis(double fx, double fy, double moment_about_origin) const {
    const auto c = axis();
    return {fx, fy, moment_about_origin - (c[0] * fy - c[1] * fx)};
  }

  Push push(const fem::SurfaceResultant& load, const Plate& plate) const {
    using Component = fem::SurfaceResultant::Component;
    const bool enters =
        std::any_of(meshed_.mesh.ports.begin(), meshed_.mesh.ports.end(), [&](const auto& port) {
          return port.name == plate.port && port.boundary_id == load.surface.boundary_id;
        });
    if (!enters) return {};
    const auto& at = load.surface.centre_m;
    if (load.component == Component::fx) return about_axis(plate.share, 0, -at[1] * plate.share);
    if (load.component == Component::fy) return about_axis(0, plate.share, at[0] * plate.share);
    if (load.component == Component::torque) return {0, 0, plate.share};
    return {};
  }

  /// rho times the acceleration field.
  Push push(const fem::BodyForce& load, const Plate& plate) const {
    using Field = fem::BodyForce::Field;
    Push sum{};
    for (const auto* region : {"structure", "exciter"}) {
      if (!acts_on(load, region)) continue;
      const auto& w = region == std::string("structure") ? plate.own : plate.of_exciter;
      Push push{};
      if (load.field == Field::translation_x) push = about_axis(w.mass_kg, 0, -w.y_kg_m);
      if (load.field == Field::translation_y) push = about_axis(0, w.mass_kg, w.x_kg_m);
      if (load.field == Field::rotation) push = about_axis(-w.y_kg_m, w.x_kg_m, w.polar_kg_m2);
      if (load.field == Field::spin) push = about_axis(w.x_kg_m, w.y_kg_m, 0);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += push[i];
    }
    return sum;
  }
  bool acts_on(const fem::BodyForce& load, const std::string& name) const {
    if (load.volume_ids.empty()) return true;
    return std::any_of(meshed_.regions.begin(), meshed_.regions.end(), [&](const auto& region) {
      return region.name == name && region.volume_ids == load.volume_ids;
    });
  }

  const meshes::Chamber& chamber_;
  const BodyScene& body_;
  const MeshedBody& meshed_;
  std::vector<Plate> plates_;
};

}  // namespace

std::optional<fem::UnitResponses> plated_tube_responses(const BodyScene& body, const MeshedBody& meshed,
                                                        const std::vector<fem::UnitLoad>& loads) {
  const auto* shape = std::get_if<ChamberShape>(&body.shape);
  if (shape == nullptr) return std::nullopt;
  const Plates plates(body, meshed);
  fem::UnitResponses r;
  r.solver.reason = "thin tube with rigid plates";
  for (const auto& load : loads) r.channels.push_back(load.channel);

  std::vector<fem::TubePoint> points;
  for (const auto& spot : meshed.mesh.hot_spots)
    for (const auto& p : {spot.near_m, spot.far_m}) {
      r.nodes.xyz_m.insert(r.nodes.xyz_m.end(), p.begin(), p.end());
      points.push_back(
          {std::atan2(p[1] - shape->geometry.tube.axis_y_m, p[0] - shape->geometry.tube.axis_x_m), p[2]});
    }
  r.nodes.n = points.size();
  r.nodes.volume_m3.assign(r.nodes.n, 0);
  const auto unit_Pa = fem::plated_tube_stress_Pa(plates.tube, points);

  const std::size_t n_plates = plates.tube.plates.size(), n_units = n_plates * fem::n_plate_loads;
  r.n_dofs = n_units;
  r.resultants.resize(loads.size());
  r.displacement_m.assign(r.nodes.n * loads.size() * 3, 0);
  r.stress_Pa.assign(r.nodes.n * loads.size() * 6, 0);
  for (std::size_t k = 0; k < loads.size(); ++k)
    for (std::size_t p = 0; p < n_plates; ++p) {
      const auto push = plates.push(loads[k], p);
      for (std::size_t i = 0; i < r.nodes.n; ++i)
        for (std::size_t c = 0; c < push.size(); ++c)
          for (std::size_t d = 0; d < 6; ++d)
            r.stress_Pa[(i * loads.size() + k) * 6 + d] +=
                push[c] * unit_Pa[i * n_units + p * fem::n_plate_loads + c][d];
    }
  return r;
}

}  // namespace pipelines
