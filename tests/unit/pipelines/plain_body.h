/// A shaft of a shipped scene without a mesh: ports and masses of its plain cylinders, fillets left out.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "bodies.h"
#include "pipelines/body_mesh.h"
#include "pipelines/machine_masses.h"
#include "pipelines/scene.h"

namespace plain {

inline pipelines::Scene scene(const std::string& name) {
  return pipelines::read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes" / (name + ".toml"));
}

inline fem::MassProperties masses(const meshes::Shaft& shaft, double density_kg_m3) {
  fem::MassProperties m;
  for (const auto& s : shaft.segments)
    for (const double diameter : {s.diameter_m, s.bore_m}) {
      const double r = diameter / 2, length = s.end_m - s.begin_m, z = (s.begin_m + s.end_m) / 2;
      const double mass = (diameter == s.bore_m ? -1 : 1) * density_kg_m3 * M_PI * r * r * length;
      m.mass_kg += mass;
      m.first_moment_kg_m[2] += mass * z;
      m.second_moments_kg_m2[0] += mass * r * r / 4;
      m.second_moments_kg_m2[1] += mass * r * r / 4;
      m.second_moments_kg_m2[2] += mass * (z * z + length * length / 12);
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
      result.push_back(bodies::port(s.name, Kind::seat, id, {s.begin_m, s.end_m}, s.diameter_m / 2));
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
