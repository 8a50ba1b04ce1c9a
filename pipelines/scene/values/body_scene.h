/// A body as a scene describes it: shape, material, how loads meet it. Values in SI units.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/solver_choice.h"
#include "meshes/chamber/chamber_geometry.h"
#include "meshes/imported/import.h"
#include "meshes/keyed_shaft/keyway.h"
#include "meshes/shaft_layout/shaft_geometry.h"
#include "pipelines/scene/values/body_options.h"
#include "pipelines/scene/values/fatigue_scene.h"
#include "pipelines/scene/values/pressure_pattern.h"

namespace pipelines {

struct ShaftShape {
  meshes::Shaft geometry;
  meshes::ShaftMeshControl mesh;
  std::vector<meshes::Keyway> keyways;  ///< some: the shaft is meshed with tetrahedra, by `solid`
  meshes::SolidControl solid;
};

struct ChamberShape {
  meshes::Chamber geometry;
  meshes::ChamberMeshControl mesh;
};

/// Mass beside the mesh, as the scene gives it.
struct AddedMass {
  std::string name, port, region;  ///< region of the chamber: "structure" or "exciter"
  double mass_kg = 0;
  std::array<double, 2> centre_m{};  ///< from the port's own point
  double polar_inertia_kg_m2 = 0;    ///< about its own centre
};

using BodyShape = std::variant<ShaftShape, ChamberShape, meshes::Import>;

/// The key of [<body>.mesh] that a field of a mesh control is read from: the field without its unit.
std::string mesh_key(const std::string& control);

struct BodyScene {
  std::string name;    ///< "shaft", "chamber", "drum", "axle", "part": table and directory
  std::string origin;  ///< "file:line:column: table", named by errors that meshing brings to light
  std::map<std::string, std::string> mesh_keys;  ///< "file:line:column: key = value" by key of [<name>.mesh]
  BodyOptions options;                           ///< options of the body's kind (body_reader.h)
  BodyShape shape;
  fem::Material material;
  std::string material_name;
  std::string strength_source;  ///< "S355J2, up to 16 mm, EN 10025-2"; empty: the scene gives the strengths
  double yield_strength_Pa = 0;
  int pressure_harmonics = 4;                      ///< highest harmonic where `pressures` has no entry
  std::map<std::string, PressureModel> pressures;  ///< by port
  /// Ports whose pressure a search has found to be felt where stress leads: harmonics that their patterns
  /// have not are solved too (PressureModel::solves_missing).
  std::set<std::string> felt_seats;
  std::vector<AddedMass> added_masses;
  fem::Solver solver = fem::Solver::automatic;
  /// Degree of the polynomials in a cell (fem::Body); 2 in every scene, accuracy studies take 1 and 3 too.
  int degree = 2;
  /// Cells cut into eight after meshing, cycle after cycle (fem::Body): a search chooses them.
  std::vector<fem::RefinementCycle> refinements;
  std::optional<FatigueScene> fatigue;  ///< none: fatigue_off, or fatigue_missing says why
  bool fatigue_off = false;             ///< switched off by the scene: `fatigue = "off"`
  /// Why fatigue is not judged, with the two lines that add what is missing; empty if judged or switched off.
  std::string fatigue_missing;
  int natural_frequencies = 0;  ///< how many to compute and compare with the loads; 0: none
  int critical_speeds = 0;      ///< how many of a shaft to compute in each direction of whirl; 0: none
  /// Stiffness of its bearings across the axis, in the order of BodyReader::supporting_ports; empty: rigid.
  std::vector<double> bearing_stiffness_N_m;
  std::string difference_port;  ///< carries what the load stage's masses and the mesh's differ by

  /// Places where a search found that stress grows without bound: kept out of the peak like sharp edges.
  std::vector<meshes::SharpEdge> singular;

  // Defined in the .cc file: else every file that copies one compiles the copies of all members anew.
  BodyScene();
  BodyScene(const BodyScene&);
  BodyScene(BodyScene&&) noexcept;
  BodyScene& operator=(const BodyScene&);
  BodyScene& operator=(BodyScene&&) noexcept;
  ~BodyScene();

  const ShaftShape* shaft() const { return std::get_if<ShaftShape>(&shape); }
};

/// The pressure on a port of which the scene says nothing: a half-cosine; under a mill's charge, on
/// inner_wall, of a sector that is taken as known to half_angle_share.
PressureModel usual_pressure(const BodyScene& body, const std::string& port);

}  // namespace pipelines
