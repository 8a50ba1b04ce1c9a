/// A shaft of a shipped scene without a mesh: ports and masses of its plain cylinders, fillets left out.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/unit/pipelines/examples/bodies.h"

namespace plain {

inline pipelines::Scene scene(const std::string& name) {
  return pipelines::read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes" / (name + ".toml"));
}

/// Where a segment's axis lies.
inline std::array<double, 2> axis_m(const meshes::ShaftSegment& s) {
  return {s.eccentricity_m * std::cos(s.eccentricity_angle_rad),
          s.eccentricity_m * std::sin(s.eccentricity_angle_rad)};
}

/// Cylinders about the segments' axes, less the bores about the shaft's.
inline fem::MassProperties masses(const meshes::Shaft& shaft, double density_kg_m3) {
  fem::MassProperties m;
  for (const auto& s : shaft.segments)
    for (const bool is_bore : {false, true}) {
      const double r = (is_bore ? s.bore_m : s.diameter_m) / 2, length = s.end_m - s.begin_m;
      const auto [x, y] = is_bore ? std::array<double, 2>{} : axis_m(s);
      const double z = (s.begin_m + s.end_m) / 2;
      const double mass = (is_bore ? -1 : 1) * density_kg_m3 * M_PI * r * r * length;
      m.mass_kg += mass;
      const std::array<double, 3> first{x, y, z};
      for (std::size_t c = 0; c < 3; ++c) m.first_moment_kg_m[c] += mass * first[c];
      const std::array<double, 6> second{
          r * r / 4 + x * x, r * r / 4 + y * y, z * z + length * length / 12, x * y, y * z, x * z};
      for (std::size_t c = 0; c < 6; ++c) m.second_moments_kg_m2[c] += mass * second[c];
    }
  return m;
}

/// Ports of all segments, over their whole length.
inline std::vector<meshes::Port> ports(const meshes::Shaft& shaft) {
  using Kind = meshes::Port::Kind;
  std::vector<meshes::Port> result;
  for (const auto& s : shaft.segments) {
    const int id = 1 + int(result.size());
    if (s.is_port)
      result.push_back(
          bodies::port(s.name, Kind::seat, id, {s.begin_m, s.end_m}, s.diameter_m / 2, axis_m(s)));
    if (!s.bore_port.empty())
      result.push_back(bodies::port(s.bore_port, Kind::bore, id + 100, {s.begin_m, s.end_m}, s.bore_m / 2));
  }
  return result;
}

/// As meshing would give it, but for mesh and model.
inline pipelines::MeshedBody meshed(const pipelines::BodyScene& body) {
  pipelines::MeshedBody result;
  const auto& geometry = body.shaft()->geometry;
  result.mesh.ports = ports(geometry);
  result.masses = masses(geometry, body.material.density_kg_m3);
  result.regions = {{"", {}, result.masses}};
  return result;
}

inline pipelines::LoadedBody loaded(const pipelines::BodyScene& body) {
  const auto m = meshed(body);
  return {body.name, m.mesh.ports, m.regions, body.pressures};
}

}  // namespace plain
