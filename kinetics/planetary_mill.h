/// Planetary mill with a belt drive: loads on the drum, its trunnions and its axle.
///
/// Source: "The influence of constructive and technological parameters on dynamic loads in elements of a
/// planetary mill with a belt drive" (Belarusian National Technical University, received 2016-09-19),
/// equations (1)-(18). Errata and conventions: kinetics/README.md.
///
/// The carrier turns counter-clockwise. Everything is said in the CARRIER frame: origin A on the drum's axis,
/// x outwards from the central axis O to A, y a right angle counter-clockwise of it. phi is the angle of OA
/// above the horizontal; gravity is -g (sin phi, cos phi) there. Torques are counter-clockwise positive.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "kinetics/values/load_history.h"

namespace kinetics {

/// `as_published`: the paper's formulas to the letter. `as_plotted`: the reading that reproduces its figures.
/// `consistent`: mechanics that closes to round-off.
enum class PlanetaryConvention { as_published, as_plotted, consistent };

/// T1 = ratio T2 at all times, as the paper has it. Where the belt has to turn the other way (T1 < T2),
/// `consistent` swaps the strands; the other two conventions let both tensions become negative.
struct RatioBelt {
  double ratio = 2;  ///< [-] tight over slack, > 1
};

/// Both strands as slack as Eytelwein's limit of slip allows: tight = slack exp(friction * wrap).
struct EytelweinBelt {
  double friction = 0;  ///< [mu] > 0
};

/// Both strands share their pretension's sum at all times: T = F0 +- (T1 - T2) / 2.
struct PretensionedBelt {
  double pretension_N = 0;  ///< [F0] of one strand, >= 0
  double friction = 0;      ///< [mu] > 0; only for the warning of slip
};

using PlanetaryBelt = std::variant<RatioBelt, EytelweinBelt, PretensionedBelt>;

/// Lengths by the paper's criteria.
struct PlanetaryRatios {
  double k = 0;  ///< r_A / (l_OA + r_A), (6), between 0 and 1
  double b = 0;  ///< inner drum radius / r_A, (7), > 0
  double c = 0;  ///< r_A / r_O, (8), > 0
};

/// Lengths as they are; all > 0.
struct PlanetaryLengths {
  double carrier_m = 0;         ///< [l_OA] from the central axis to the drum's
  double central_pulley_m = 0;  ///< [r_O] radius of the pulley that stands still
  double drum_pulley_m = 0;     ///< [r_A] radius of the pulley on the drum
};

/// The charge fills a circular segment of the drum, at rest in the carrier frame. Exactly one of the three
/// fillings is given, if an effect of the charge is on.
struct PlanetaryCharge {
  double bulk_density_kg_m3 = 0;
  std::optional<double> filling;         ///< [S'/S_b] of the drum's cross-section, 0 .. 1
  std::optional<double> void_fraction;   ///< 1 - filling: exact for a drum that is nearly full
  std::optional<double> half_angle_rad;  ///< [gamma] of the segment, 0 .. pi
  double segment_angle_rad = 0;          ///< [alpha] the centroid lies along (sin alpha, -cos alpha) from A
};

/// Parameters of the machine. Names of the paper in brackets. A mass may be zero where no effect that is on
/// uses it.
struct PlanetaryMill {
  PlanetaryConvention convention = PlanetaryConvention::consistent;
  double gravity_m_s2 = 9.81;
  double speed_rad_s = 0;             ///< [Omega] of the carrier, counter-clockwise, > 0
  double initial_angle_rad = 0;       ///< phi at t = 0
  double initial_drum_angle_rad = 0;  ///< psi at t = 0, of the drum against the carrier
  double drum_radius_m = 0;           ///< [r_b] inner, > 0
  double drum_length_m = 0;           ///< [L] > 0 where the charge is in effect
  double drum_mass_kg = 0;            ///< [m_A] shell, covers and pulley
  std::variant<PlanetaryRatios, PlanetaryLengths> geometry;
  PlanetaryCharge charge;
  PlanetaryBelt belt;
  /// Where the pulleys contain each other (|sin beta| > 1) there is no belt: refused, unless this is set
  /// under one of the two conventions of the paper. Then cos beta = 0: for the left part of Fig. 8 only.
  bool belt_beyond_geometry = false;
};

/// What follows from the machine's lengths alone.
struct PlanetaryGeometry {
  double carrier_m = 0, central_pulley_m = 0, drum_pulley_m = 0;  ///< as in PlanetaryLengths
  double belt_sine = 0;    ///< sin beta = (r_O - r_A) / l_OA, (5) with its sign, of the true belt
  double belt_cosine = 0;  ///< cos beta; 0 beyond geometry
  double wrap_rad = 0;     ///< angle of contact of the belt on the smaller pulley, pi - 2 asin |sin beta|
  double drum_speed_ratio = 0;      ///< [omega / Omega] absolute spin of the drum, (c - 1) / c
  double relative_speed_ratio = 0;  ///< spin of the drum against the carrier / Omega, -1 / c
};

/// @throws MachineRefused if a length or ratio is not a positive finite number, or k is not below 1
PlanetaryGeometry planetary_geometry(const PlanetaryMill& mill);

/// What follows from the charge's filling.
struct PlanetaryChargeBody {
  double filling = 0;            ///< [S'/S_b]
  double half_angle_rad = 0;     ///< [gamma]
  double mass_kg = 0;            ///< [m_C] rho L S', (13)
  double first_moment_kg_m = 0;  ///< q_C = m_C l_AC about A = rho L (2/3) (r_b sin gamma)^3
  double centroid_m = 0;         ///< [l_AC] (12)
};

/// Exact to a few roundings for fillings from 1e-300 to 1 - 1e-300 (as void_fraction).
/// @throws MachineRefused unless exactly one filling is given, within its range
PlanetaryChargeBody planetary_charge_body(const PlanetaryMill& mill);

/// The effects that the machine knows under a convention, in the order of summation.
/// `charge_relative` is called `charge_offset` under `consistent`: it is transport inertia of the centroid.
const std::vector<EffectInfo>& planetary_mill_effects(PlanetaryConvention convention);

/// Evaluates the named effects, and only those, over the instants of the grid. A turn is one of the carrier.
///
/// Resultants (CARRIER frame, through A; a force and a torque about A):
///   "axle"        load on the axle, (X_A, -Y_A): what a stub axle fixed to the carrier receives; no torque
///   "trunnions"   reaction of the carrier's bearings on the drum, (-X_A, +Y_A); no torque
///   "drum"        volume load of shell, covers and pulley, m_A (Omega^2 l_OA e_x + G)
///   "inner_wall"  load of the charge on the drum's wall; torque l_AC u x F, which adds up to M_A
///   "pulley"      pull of both strands on the drum's pulley, and their torque -(T1 - T2) r_A. With the
///                 effect `belt` off: a contribution "drive_couple", the external couple -M_A in its place
/// "axle" and "trunnions" are always there; the others only if an effect that is on loads them. The charge
/// and the drum are loaded by their forces' true lines under every convention; under as_published (and where
/// c > 1 under as_plotted) the axle's load is the paper's and does not balance them: closure_force tells by
/// how much.
///
/// Quantities: X_A, Y_A, R_A, M_A, psi, drum_speed, drum_relative_speed, carrier_power, gravity_power,
/// closure_force and closure_moment (relative, the moment about A; true lines of action, the strands at their
/// tangent points); with `belt` T1, T2, belt_difference, belt_power; without it drive_couple; with the charge
/// charge_power. Under `consistent` with all effects on, carrier_power + gravity_power = belt_power =
/// charge_power at every instant.
/// @param effects  names in any order; they are summed in the order of planetary_mill_effects. All but `belt`
///                 are independent of each other; the belt balances the M_A of those that are on
/// @throws MachineRefused naming parameter, value and remedy: NaN or infinity, what must be positive,
///         a mass or filling that an effect lacks, more than one filling, an unknown effect (with the
///         nearest known one), a machine that cannot be built under `consistent` (a warning under the other
///         two), a belt beyond geometry
LoadHistory compute_loads(const PlanetaryMill& mill, const std::vector<std::string>& effects,
                          const TimeGrid& grid);

/// X_A and Y_A as functions of phi: mean + cosine cos(phi) + sine sin(phi), an ellipse.
struct PlanetaryHodograph {
  struct Component {
    double mean_N = 0, cosine_N = 0, sine_N = 0;
    double amplitude_N() const;
  };
  Component X_A, Y_A;
  double R_mean_N = 0, R_amplitude_N = 0,
         R_phase_rad = 0;                    ///< first order: mean + amplitude cos(phi - phase)
  double R_max_N = 0, phi_of_R_max_rad = 0;  ///< exact, from the ellipse; phi in 0 .. 2 pi
  double R_min_N = 0, phi_of_R_min_rad = 0;
};

/// Closed form of the axle's load over all angles, for the named effects.
/// @return empty if it is no ellipse: T1 - T2 changes its sign in a turn and the belt's model swaps strands
/// @throws MachineRefused as compute_loads does
std::optional<PlanetaryHodograph> hodograph(const PlanetaryMill& mill,
                                            const std::vector<std::string>& effects);

/// A resultant seen from axes that turn with the drum, as its trunnions do: F_body = R(-psi) F, torque as it
/// is, for the total and every contribution. What is constant in the carrier frame then reverses fully.
/// @throws std::out_of_range if the history has no quantity "psi"
Resultant turned_with_drum(const LoadHistory& history, const Resultant& resultant);

/// The smallest whole number q of carrier turns after which loads in the drum's axes repeat, 1/c = p/q; empty
/// if no q up to `most_turns` gives the ratio to 1e-9. In the carrier frame all loads repeat every turn.
std::optional<int> period_in_turns(const PlanetaryMill& mill, int most_turns = 1000);

}  // namespace kinetics
