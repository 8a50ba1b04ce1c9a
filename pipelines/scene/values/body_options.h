/// How each kind of body takes its loads, as far as the scene says it. Values in SI units.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace pipelines {

/// Mass that moves with the body without being meshed: covers, a pulley, the difference between the mass that
/// the load stage has and that of the mesh. It loads a port; about the origin of the body's frame.
struct AttachedMass {
  std::string name, port;
  double mass_kg = 0;                         ///< negative where the mesh has too much
  std::array<double, 2> first_moment_kg_m{};  ///< m x, m y
  double polar_inertia_kg_m2 = 0;             ///< integral of rho (x^2 + y^2)
};

/// A force that the scene itself puts on a port, as an effect of its own: constant in the fixed frame (belt
/// pull) or in the shaft's (imbalance).
struct GivenForce {
  std::string effect, port;
  std::array<double, 3> force_N{};
  bool turns_with_shaft = false;
};

struct VibratoryShaftOptions {
  std::vector<double> debalance_shares = {0.5, 0.5};
};

/// What takes the couple of an attitude that is held (effect `pitch_guide`, with `pitch` off).
enum class PitchGuide {
  body,  ///< a body load without resultant, about the mass centre
  feet   ///< opposite vertical forces on the first two feet
};

/// The vibratory mill's chamber.
struct ChamberOptions {
  PitchGuide pitch_guide = PitchGuide::body;
  bool elastic_feet = false;  ///< the springs' stiffness is part of the body
};

/// The planetary mill's drum: nothing to choose.
struct DrumOptions {};

/// One of the two stubs that carry the drum's bearings, fixed to the carrier.
struct StubAxleOptions {
  double bearing_span_m = 0;  ///< distance between the drum's two bearings
  double pulley_plane_m = 0;  ///< plane of the belt, from the middle between the bearings
  double pulley_mass_kg = 0;  ///< the part of the drum's mass m_A that lies in the pulley's plane
  bool pulley_side = true;    ///< whether it is the stub on the pulley's side
};

/// A shaft of a drive train that carries one of its inertias.
struct TrainShaftOptions {
  struct Torque {
    std::string port, role;  ///< role of the resultant, "<element>_on_<inertia>"
  };
  std::string inertia;          ///< the inertia of the train that the shaft is
  std::vector<Torque> torques;  ///< torques of all elements on that inertia
  std::array<std::string, 2> bearings{"bearing_1", "bearing_2"};
  std::string axial_bearing;  ///< takes axial forces; empty: there are none
  std::vector<GivenForce> forces;
};

/// A body under the loads of a table, in its own frame.
struct TableBodyOptions {
  std::vector<std::string> bearings;  ///< none, or two that balance forces across and tilting moments
  std::string axial_support;          ///< balances fz; empty: nothing does
  std::string torque_support;         ///< balances the torque; empty: nothing does
  std::string clamp;                  ///< balances all of these alone; empty: nothing does
};

/// What the scene says to one body's kind; the alternative says which kind that is, in the order of the table
/// of kinds (scene/kinds/table.cc; their loads: loads/bodies/table.cc).
using BodyOptions = std::variant<VibratoryShaftOptions, ChamberOptions, DrumOptions, StubAxleOptions,
                                 TrainShaftOptions, TableBodyOptions>;

}  // namespace pipelines
