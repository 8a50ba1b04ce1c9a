#include "pipelines/loads/mass_comparison.h"

#include <algorithm>
#include <sstream>

#include "pipelines/common/errors.h"
#include "pipelines/common/name_lists.h"

namespace pipelines {
namespace {

constexpr double largest_share = 0.2;  // a mesh that far off is another machine

}  // namespace

PlanarMass planar_mass(const fem::MassProperties& m) {
  return {m.mass_kg, m.first_moment_kg_m[0], m.first_moment_kg_m[1],
          m.second_moments_kg_m2[0] + m.second_moments_kg_m2[1]};
}

PlanarMass planar_mass(const std::vector<AttachedMass>& list) {
  PlanarMass sum;
  for (const auto& m : list)
    sum += {m.mass_kg, m.first_moment_kg_m[0], m.first_moment_kg_m[1], m.polar_inertia_kg_m2};
  return sum;
}

bool is_open(const Scene& scene, const std::string& mass) {
  return contains(scene.masses_from_mesh, mass);
}

std::vector<AttachedMass> added_masses(const BodyScene& scene, const meshes::BodyMesh& mesh,
                                       const std::string& region) {
  std::vector<AttachedMass> result;
  for (const auto& added : scene.added_masses) {
    if (added.region != region) continue;
    const auto port = std::find_if(mesh.ports.begin(), mesh.ports.end(),
                                   [&](const auto& p) { return p.name == added.port; });
    if (port == mesh.ports.end())
      throw StageRefused(scene.name + ": the added mass \"" + added.name + "\" sits on the port \"" +
                         added.port + "\", which the mesh does not have");
    const double x = port->axis_x_m + added.centre_m[0], y = port->axis_y_m + added.centre_m[1];
    result.push_back({added.name,
                      added.port,
                      added.mass_kg,
                      {added.mass_kg * x, added.mass_kg * y},
                      added.polar_inertia_kg_m2 + added.mass_kg * (x * x + y * y)});
  }
  return result;
}

double MassComparison::compare(const std::string& name, const std::string& unit, double given, double mesh,
                               bool from_mesh) {
  figures_.push_back({body_, name, unit, given, mesh, from_mesh});
  const double share = figures_.back().share();
  if (share > largest_share) {
    std::ostringstream text;
    text << origin_ << ": the machine's " << name << " is " << given << ' ' << unit
         << ", mesh and added masses give " << mesh << ' ' << unit << ": " << 100 * share
         << " % apart, at most 20 % can be carried; correct one of "
         << "them, or leave the machine's out, so that the mesh gives it";
    throw StageRefused(text.str());
  }
  return given - mesh;
}

void add_difference(std::vector<AttachedMass>& list, const std::string& port, const PlanarMass& rest) {
  if (rest.mass_kg == 0 && rest.x_kg_m == 0 && rest.y_kg_m == 0 && rest.polar_kg_m2 == 0) return;
  list.push_back(
      {"difference to the mesh", port, rest.mass_kg, {rest.x_kg_m, rest.y_kg_m}, rest.polar_kg_m2});
}

}  // namespace pipelines
