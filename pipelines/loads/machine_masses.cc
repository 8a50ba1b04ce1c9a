#include "pipelines/loads/machine_masses.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "pipelines/common/errors.h"

namespace pipelines {
namespace {

constexpr double largest_share = 0.2;  // a mesh that far off is another machine

bool is_open(const Scene& scene, const std::string& name) {
  const auto& open = scene.masses_from_mesh;
  return std::find(open.begin(), open.end(), name) != open.end();
}

/// Mass, first moment and polar inertia about the origin: what planar motion feels of a body.
struct PlanarMass {
  double mass_kg = 0, x_kg_m = 0, y_kg_m = 0, polar_kg_m2 = 0;

  PlanarMass& operator+=(const PlanarMass& other) {
    mass_kg += other.mass_kg;
    x_kg_m += other.x_kg_m;
    y_kg_m += other.y_kg_m;
    polar_kg_m2 += other.polar_kg_m2;
    return *this;
  }
};

PlanarMass of_mesh(const fem::MassProperties& m) {
  return {m.mass_kg, m.first_moment_kg_m[0], m.first_moment_kg_m[1],
          m.second_moments_kg_m2[0] + m.second_moments_kg_m2[1]};
}

PlanarMass of_added(const std::vector<AttachedMass>& list) {
  PlanarMass sum;
  for (const auto& m : list)
    sum += {m.mass_kg, m.first_moment_kg_m[0], m.first_moment_kg_m[1], m.polar_inertia_kg_m2};
  return sum;
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

/// Collects the figures of one body and what they leave to be carried.
class Comparison {
public:
  Comparison(const std::string& body, std::vector<MassFigure>& figures) : body_(body), figures_(figures) {}

  /// @return given - mesh
  double compare(const std::string& name, const std::string& unit, double given, double mesh,
                 bool from_mesh) {
    figures_.push_back({body_, name, unit, given, mesh, from_mesh});
    const double share = figures_.back().share();
    if (share > largest_share) {
      std::ostringstream text;
      text << body_ << ": the machine's " << name << " is " << given << ' ' << unit
           << ", mesh and added masses give " << mesh << ' ' << unit << ": " << 100 * share
           << " % apart, at most 20 % can be carried; correct one of "
           << "them, or leave the machine's out, so that the mesh gives it";
      throw StageRefused(text.str());
    }
    return given - mesh;
  }

private:
  std::string body_;
  std::vector<MassFigure>& figures_;
};

void add_difference(std::vector<AttachedMass>& list, const BodyScene& body, const PlanarMass& d) {
  if (d.mass_kg == 0 && d.x_kg_m == 0 && d.y_kg_m == 0 && d.polar_kg_m2 == 0) return;
  list.push_back(
      {"difference to the mesh", body.difference_port, d.mass_kg, {d.x_kg_m, d.y_kg_m}, d.polar_kg_m2});
}

void agree_chamber(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                   MassAgreement& result) {
  auto& mill = std::get<kinetics::VibratoryMill>(result.machine);
  auto& attached = result.attached[body.name];
  attached.structure = added_masses(body, meshed.mesh, "structure");
  attached.exciter = added_masses(body, meshed.mesh, "exciter");
  PlanarMass structure, exciter;
  for (const auto& region : meshed.regions)
    (region.name == "exciter" ? exciter : structure) += of_mesh(region.masses);
  structure += of_added(attached.structure);
  exciter += of_added(attached.exciter);

  const bool open = is_open(scene, "structure"), exciter_open = is_open(scene, "exciter");
  if (exciter_open) mill.exciter_mass_kg = exciter.mass_kg;
  if (open) {
    mill.structure_mass_kg = structure.mass_kg;
    mill.structure_centre_m = {structure.x_kg_m / structure.mass_kg, structure.y_kg_m / structure.mass_kg};
    mill.pitch_inertia_kg_m2 = structure.polar_kg_m2 + exciter.polar_kg_m2;
  }
  Comparison comparison(body.name, result.figures);
  const double m1 = mill.structure_mass_kg;
  PlanarMass rest;
  rest.mass_kg = comparison.compare("structure mass", "kg", m1, structure.mass_kg, open);
  // The first moment as a whole: one small component is no mistake.
  const double sx = m1 * mill.structure_centre_m[0], sy = m1 * mill.structure_centre_m[1];
  rest.x_kg_m = sx - structure.x_kg_m;
  rest.y_kg_m = sy - structure.y_kg_m;
  comparison.compare("structure first moment", "kg m", std::hypot(sx, sy),
                     std::hypot(sx, sy) + std::hypot(rest.x_kg_m, rest.y_kg_m), open);
  rest.polar_kg_m2 = comparison.compare("pitch inertia", "kg m2", mill.pitch_inertia_kg_m2,
                                        structure.polar_kg_m2 + exciter.polar_kg_m2, open);
  add_difference(attached.structure, body, rest);
  PlanarMass rest_2;
  rest_2.mass_kg =
      comparison.compare("exciter mass", "kg", mill.exciter_mass_kg, exciter.mass_kg, exciter_open);
  rest_2.x_kg_m = -exciter.x_kg_m;  // the load stage has its centre at E'
  rest_2.y_kg_m = -exciter.y_kg_m;
  auto on_bore = body;
  on_bore.difference_port = "housing_bore";
  add_difference(attached.exciter, on_bore, rest_2);
}

void agree_drum(const Scene& scene, const BodyScene& body, const MeshedBody& meshed, MassAgreement& result) {
  auto& mill = std::get<kinetics::PlanetaryMill>(result.machine);
  auto& attached = result.attached[body.name].structure;
  attached = added_masses(body, meshed.mesh, "");
  PlanarMass drum = of_mesh(meshed.masses);
  drum += of_added(attached);
  const bool open = is_open(scene, "drum");
  if (open) mill.drum_mass_kg = drum.mass_kg;
  Comparison comparison(body.name, result.figures);
  PlanarMass rest;
  rest.mass_kg = comparison.compare("drum mass", "kg", mill.drum_mass_kg, drum.mass_kg, open);
  rest.x_kg_m = -drum.x_kg_m;  // the load stage has its centre on the axis
  rest.y_kg_m = -drum.y_kg_m;
  add_difference(attached, body, rest);
}

void agree_train(const Scene& scene, const BodyScene& body, const MeshedBody& meshed, MassAgreement& result) {
  auto& train = std::get<kinetics::DriveTrain>(result.machine);
  auto& attached = result.attached[body.name].structure;
  attached = added_masses(body, meshed.mesh, "");
  PlanarMass shaft = of_mesh(meshed.masses);
  shaft += of_added(attached);
  const auto inertia = std::find_if(train.inertias.begin(), train.inertias.end(),
                                    [&](const auto& i) { return i.name == body.train.inertia; });
  if (inertia == train.inertias.end())
    throw StageRefused("shaft.inertia = \"" + body.train.inertia + "\": the train has no such inertia");
  const bool open = is_open(scene, inertia->name);
  if (open) inertia->inertia_kg_m2 = shaft.polar_kg_m2;
  Comparison comparison(body.name, result.figures);
  PlanarMass rest;
  rest.polar_kg_m2 = comparison.compare("inertia of " + inertia->name, "kg m2", inertia->inertia_kg_m2,
                                        shaft.polar_kg_m2, open);
  // What of the inertia's force field a shaft out of centre leaves is no part of a torsional train.
  rest.x_kg_m = -shaft.x_kg_m;
  rest.y_kg_m = -shaft.y_kg_m;
  add_difference(attached, body, rest);
}

}  // namespace

double MassFigure::share() const {
  const double difference = std::abs(given - mesh);
  return difference == 0 ? 0 : difference / std::max(std::abs(given), 1e-300);
}

MassAgreement agree_masses(const Scene& scene, const std::vector<MeshedBody>& bodies) {
  MassAgreement result{scene.machine, {}, {}};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    result.attached[body.name];
    if (body.role == BodyRole::chamber) agree_chamber(scene, body, bodies[i], result);
    if (body.role == BodyRole::drum) agree_drum(scene, body, bodies[i], result);
    if (body.role == BodyRole::train_shaft) agree_train(scene, body, bodies[i], result);
  }
  return result;
}

}  // namespace pipelines
