#include "pipelines/search/cheap_models/described_body.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "meshes/chamber/chamber.h"
#include "meshes/imported/imported.h"
#include "meshes/keyed_shaft/solid_shaft.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/values/refused.h"
#include "pipelines/judge/estimates/fineness.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/fitted.h"

namespace pipelines {
namespace {

fem::MassProperties swept_masses(const meshes::SweptVolume& volume, double density_kg_m3) {
  fem::MassProperties masses;
  masses.volume_m3 = volume.volume_m3;
  masses.mass_kg = density_kg_m3 * volume.volume_m3;
  for (std::size_t i = 0; i < 3; ++i) masses.first_moment_kg_m[i] = density_kg_m3 * volume.first_m4[i];
  for (std::size_t i = 0; i < 6; ++i) masses.second_moments_kg_m2[i] = density_kg_m3 * volume.second_m5[i];
  return masses;
}

void add_masses(const fem::MassProperties& part, fem::MassProperties& sum) {
  sum.volume_m3 += part.volume_m3;
  sum.mass_kg += part.mass_kg;
  for (std::size_t i = 0; i < 3; ++i) sum.first_moment_kg_m[i] += part.first_moment_kg_m[i];
  for (std::size_t i = 0; i < 6; ++i) sum.second_moments_kg_m2[i] += part.second_moments_kg_m2[i];
}

MeshedBody described_chamber(const ChamberShape& shape, const fem::Material& material) {
  auto description = meshes::describe_chamber(shape.geometry, shape.mesh);
  MeshedBody result;
  result.mesh = std::move(description.body);
  for (const auto& region : result.mesh.regions) {
    RegionMass part{region.name, region.volume_ids, {}};
    for (const int id : region.volume_ids)
      add_masses(swept_masses(description.volumes[id], material.density_kg_m3), part.masses);
    add_masses(part.masses, result.masses);
    result.regions.push_back(std::move(part));
  }
  return result;
}

MeshedBody described_import(const meshes::Import& import, const fem::Material& material) {
  MeshedBody result;
  result.masses.volume_m3 = meshes::outline_imported(import).volume_m3;
  result.masses.mass_kg = material.density_kg_m3 * result.masses.volume_m3;
  return result;
}

/// What is refused names the body's place in the scene.
template <typename Work>
auto at_origin(const BodyScene& body, Work&& work) {
  const auto place = body.origin + ": ";
  try {
    return work();
  } catch (const meshes::TooManyCells& error) {
    const auto key = body.mesh_keys.find(mesh_key(error.control()));
    throw meshes::GeometryRefused((key == body.mesh_keys.end() ? body.origin : key->second) + ": " +
                                  error.what());
  } catch (const meshes::GeometryRefused& error) {
    throw meshes::GeometryRefused(place + error.what());
  } catch (const meshes::MeshRefused& error) {
    throw meshes::MeshRefused(place + error.what());
  }
}

}  // namespace

MeshedBody describe_body(const BodyScene& body, const std::vector<kinetics::Spring>& springs) {
  if (body.shaft() != nullptr) return describe_revolved(body);
  if (const auto* chamber = std::get_if<ChamberShape>(&body.shape))
    return at_origin(body, [&] { return described_chamber(*chamber, body.material); });
  if (!can_be_refined(body)) return mesh_body(body, springs);
  return at_origin(body,
                   [&] { return described_import(std::get<meshes::Import>(body.shape), body.material); });
}

bool has_known_ports(const BodyScene& body) {
  return !std::holds_alternative<meshes::Import>(body.shape) || !can_be_refined(body);
}

std::size_t estimated_unknowns(const BodyScene& body) {
  const auto unknowns = [&](double n_cells, double each) {
    return std::size_t(n_cells * each * std::pow(body.degree / 2.0, 3));
  };
  if (const auto* shaft = body.shaft())
    return shaft->keyways.empty() ? unknowns(meshes::estimated_cells(shaft->geometry, shaft->mesh),
                                             fitted::unknowns_per_hexahedron)
                                  : unknowns(meshes::estimated_cells(shaft->geometry, shaft->solid),
                                             fitted::unknowns_per_tetrahedron);
  return at_origin(body, [&] {
    if (const auto* chamber = std::get_if<ChamberShape>(&body.shape))
      return unknowns(double(meshes::describe_chamber(chamber->geometry, chamber->mesh).n_cells),
                      fitted::unknowns_per_hexahedron);
    return unknowns(meshes::outline_imported(std::get<meshes::Import>(body.shape)).n_cells,
                    fitted::unknowns_per_tetrahedron);
  });
}

}  // namespace pipelines
