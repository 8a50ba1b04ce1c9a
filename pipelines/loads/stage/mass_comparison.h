/// What the kinds of bodies need to let the machine's masses and the mesh's agree.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipelines/loads/stage/machine_masses.h"

namespace pipelines {

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

PlanarMass planar_mass(const fem::MassProperties& m);
PlanarMass planar_mass(const std::vector<AttachedMass>& list);

/// Whether the scene leaves that mass to the mesh.
bool is_open(const Scene& scene, const std::string& mass);

/// The masses that the scene adds to one part of the body, about the origin of the body's frame.
/// @param region  "structure" and "exciter" of a chamber; empty for other bodies
/// @throws StageRefused if the mesh lacks a port
std::vector<AttachedMass> added_masses(const BodyScene& scene, const meshes::BodyMesh& mesh,
                                       const std::string& region);

/// Collects the figures of one body and what they leave to be carried.
class MassComparison {
public:
  MassComparison(const BodyScene& body, std::vector<MassFigure>& figures)
      : body_(body.name), origin_(body.origin), figures_(figures) {}

  /// @param port  that carries the difference
  /// @return given - mesh
  /// @throws StageRefused with the body's place in the scene if they are more than 20 % apart
  double compare(const std::string& name, const std::string& unit, double given, double mesh, bool from_mesh,
                 const std::string& port);

  /// First moments as a whole: one small component is no mistake.
  /// @throws StageRefused likewise
  void compare_moments(const std::string& name, const std::array<double, 2>& given_kg_m,
                       const std::array<double, 2>& mesh_kg_m, bool from_mesh, const std::string& port);

  /// A part whose centre the load stage has on its axis, beside its mass times radius of gyration.
  /// @param remedy  how a centre off the axis can be given
  /// @throws StageRefused likewise
  void compare_centre(const std::string& name, const PlanarMass& part, const std::string& port,
                      const std::string& remedy);

private:
  void add(const MassFigure& figure, const std::string& remedy);
  std::string body_, origin_;
  std::vector<MassFigure>& figures_;
};

/// What is left to be carried, as an attached mass on that port; nothing where it vanishes.
void add_difference(std::vector<AttachedMass>& list, const std::string& port, const PlanarMass& rest);

}  // namespace pipelines
