#include "pipelines/loads/stage/mass_comparison.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"

namespace pipelines {
namespace {

constexpr double largest_share = 0.2;  // a mesh that far off is another machine
// Share by which a mesh may put a centre off its axis: the coarsest chamber's is 1e-6.
constexpr double rounding_of_meshes = 1e-4;
const char* const usual_remedy = "correct one of them, or leave the machine's out, so that the mesh gives it";

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
                               bool from_mesh, const std::string& port) {
  add({body_, name, unit, given, mesh, std::abs(given - mesh), std::abs(given), port, from_mesh},
      usual_remedy);
  return given - mesh;
}

void MassComparison::compare_moments(const std::string& name, const std::array<double, 2>& given_kg_m,
                                     const std::array<double, 2>& mesh_kg_m, bool from_mesh,
                                     const std::string& port) {
  const double given = std::hypot(given_kg_m[0], given_kg_m[1]);
  add({body_, name, "kg m", given, std::hypot(mesh_kg_m[0], mesh_kg_m[1]),
       std::hypot(given_kg_m[0] - mesh_kg_m[0], given_kg_m[1] - mesh_kg_m[1]), given, port, from_mesh},
      usual_remedy);
}

void MassComparison::compare_centre(const std::string& name, const PlanarMass& part, const std::string& port,
                                    const std::string& remedy) {
  const double moment = std::hypot(part.x_kg_m, part.y_kg_m);
  const double reference = std::sqrt(std::max(0.0, part.mass_kg * part.polar_kg_m2));
  if (moment <= rounding_of_meshes * reference) return;
  add({body_, name, "kg m", 0, moment, moment, reference, port, false}, remedy);
}

void MassComparison::add(const MassFigure& figure, const std::string& remedy) {
  figures_.push_back(figure);
  if (figure.share() <= largest_share) return;
  std::ostringstream text;
  text << origin_ << ": the machine's " << figure.name << " is " << figure.given << ' ' << figure.unit
       << ", mesh and added masses give " << figure.mesh << ' ' << figure.unit << ": " << 100 * figure.share()
       << " % apart, at most 20 % can be carried; " << remedy;
  throw StageRefused(text.str());
}

void add_difference(std::vector<AttachedMass>& list, const std::string& port, const PlanarMass& rest) {
  if (rest.mass_kg == 0 && rest.x_kg_m == 0 && rest.y_kg_m == 0 && rest.polar_kg_m2 == 0) return;
  list.push_back(
      {"difference to the mesh", port, rest.mass_kg, {rest.x_kg_m, rest.y_kg_m}, rest.polar_kg_m2});
}

}  // namespace pipelines
