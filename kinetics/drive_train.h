/// Torsional vibration of drive trains: inertias on a tree of shafts, belts and gears.
///
/// Source: I. N. Zapletnikov, D. G. Popov, "Dynamic model of machines of cleaning of root crops on turning
/// vibrations" (2016), equations (1)-(18). Errata, symbols and both conventions: kinetics/README.md.
///
///   J phi'' + D phi' + K phi = M(t)                                                              (9)-(15)
///
/// phi_i is the angle of inertia i on its own shaft [rad], as a deviation from the uniform running of the
/// train (phi_i = u_i Omega t is taken out, and the drag of that running belongs to the constant torques); in
/// `transient` it is the angle itself. Every angle and torque is positive in the sense of its own shaft's
/// positive angle; u_i = speed of i / speed of the reference shaft is negative behind a reversing gear.
///
/// An element carries T from `first` to `second`: T = C (phi_first - phi_second / ratio) + damping on the
/// shaft of `first`, so -T acts on `first` and T / ratio on `second`. Reduced quantities are those of the
/// reference shaft: J' = J u^2, C' = C u^2, T' = T u (3)-(7). What is not called reduced is real.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "kinetics/values/load_history.h"

namespace kinetics {

/// A rotating inertia.
struct TrainInertia {
  std::string name;
  std::string shaft;         ///< the shaft line it sits on; all inertias of a line turn at one mean speed
  double inertia_kg_m2 = 0;  ///< >= 0; > 0 in sum with what rigid elements join it to
  double damping_N_m_s = 0;  ///< viscous damping against the ground, torque per rad/s, >= 0
  bool held = false;         ///< turns uniformly whatever the torque (a clamped end); at most one of a train
};

enum class ElementKind { shaft, belt, gear };

/// A connection of two inertias.
struct TrainElement {
  std::string name;
  ElementKind kind = ElementKind::shaft;
  std::string first, second;  ///< names of the inertias that it joins
  double ratio = 1;           ///< speed of second / speed of first; 1 for a shaft, negative: reverses
  bool rigid = false;         ///< a constraint phi_second = ratio phi_first, without stiffness and damping
  std::optional<double> stiffness_N_m_rad;  ///< C, > 0; a shaft may give modulus, length, diameter instead
  std::string stiffness_on;  ///< belts and gears: the shaft line that stiffness and damping refer to
  double damping_N_m_s = 0;  ///< viscous, on the relative speed on that same shaft, >= 0
  double loss_factor = 0;    ///< structural: C (1 + i loss_factor), >= 0
  double shear_modulus_Pa = 0, length_m = 0;  ///< shafts without given stiffness: C = G I_p / length_m
  double diameter_m = 0;                      ///< shafts: outer diameter; zero: no shear stress is computed
  double bore_m = 0;                          ///< shafts: inner diameter
  double stress_concentration = 1;            ///< K_t on the nominal shear stress, >= 1
};

/// One harmonic of torque: amplitude cos(w t - phase), a lag is positive. Exactly one of frequency and order
/// is given.
struct TorqueHarmonic {
  double amplitude_Nm = 0;
  std::optional<double> frequency_rad_s;  ///< w, > 0
  std::optional<double> order;            ///< w = order |speed of order_of|, > 0
  std::string order_of;                   ///< a shaft line; empty: the reference shaft
  double phase_rad = 0;
};

/// A torque tabulated at equal steps over one period, continued by its trigonometric polynomial (exact at the
/// entries). Exactly one of frequency and order of the period is given, as in TorqueHarmonic.
struct TorqueTable {
  std::vector<double> torque_Nm;  ///< at 0, 1/n, ... (n-1)/n of the period; empty: no table
  std::optional<double> frequency_rad_s;
  std::optional<double> order;
  std::string order_of;
};

/// A torque on one inertia, real, positive in the sense of its angle; all parts add up. An effect of its own.
struct TrainExcitation {
  std::string name;
  std::string inertia;
  double constant_Nm = 0;
  std::vector<TorqueHarmonic> harmonics;
  TorqueTable table;
};

struct DriveTrain {
  std::vector<TrainInertia> inertias;
  std::vector<TrainElement> elements;  ///< a tree: one fewer than the inertias
  std::vector<TrainExcitation> excitations;
  std::string reference_shaft;       ///< the shaft line that reduced quantities refer to
  double reference_speed_rad_s = 0;  ///< its mean speed, > 0: orders, Campbell table, time grid
  double modal_damping_ratio = 0;    ///< damping ratio of every elastic mode of the undamped train, >= 0
};

/// Mean speed of an inertia's shaft: that of the reference shaft times its ratio.
/// @throws MachineRefused if the train has no such inertia, and as natural_modes
double mean_speed_rad_s(const DriveTrain& train, const std::string& inertia);

enum class Shapes { none, all };

/// Natural modes; mode 0 of a free train is the rigid rotation, its frequency exactly zero. Columns of the
/// matrices are modes, in the order of rising frequency; the matrices are empty without shapes.
struct NaturalModes {
  Eigen::ArrayXd frequency_rad_s;
  Eigen::ArrayXXd reduced_shape;    ///< inertias x modes, reduced angles of unit length, largest positive
  Eigen::ArrayXXd shape;            ///< inertias x modes, real angles: u_i times reduced_shape
  Eigen::ArrayXXd kinetic_share;    ///< inertias x modes, of the mode's kinetic energy; columns sum to 1
  Eigen::ArrayXXd potential_share;  ///< elements x modes, of its potential energy; zero for a rigid element
};

/// Frequencies are the singular values of C^(1/2) B J^(-1/2) (B: incidence), (9)-(11): each is accurate
/// relative to itself, whatever the spread of inertias and stiffnesses.
/// @throws MachineRefused naming parameter, value and remedy, for a train that is no connected tree,
/// has
///         an inertia (joined rigidly to none) or stiffness that is not positive, shaft lines with
///         contradictory ratios, unknown names
NaturalModes natural_modes(const DriveTrain& train, Shapes shapes = Shapes::all);

/// Response to one frequency; a quantity is Re(entry e^(i w t)).
struct HarmonicResponse {
  double frequency_rad_s = 0;
  Eigen::ArrayXcd angle_rad;                     ///< per inertia
  Eigen::ArrayXcd torque_Nm, reduced_torque_Nm;  ///< per element; real: on the shaft of its first inertia
};

/// Steady state under all excitations: constant part, and one response per frequency.
struct ForcedResponse {
  /// Acceleration of the reference shaft, where a free train has no drag to the ground.
  double rigid_acceleration_rad_s2 = 0;
  /// Speed of the reference shaft beyond the mean speed, where drag balances the mean torque.
  double speed_offset_rad_s = 0;
  Eigen::ArrayXd mean_angle_rad;  ///< twist about the inertia-weighted mean (about the held inertia)
  Eigen::ArrayXd mean_torque_Nm, mean_reduced_torque_Nm;  ///< as in HarmonicResponse
  std::vector<HarmonicResponse> harmonics;                ///< rising frequency
  std::optional<double> period_s;  ///< common period; empty if constant or if the frequencies have none
  std::vector<std::string> warnings;
};

/// (16)-(18) with the right sign, damping included.
/// @throws MachineRefused as natural_modes, for an unknown inertia or order_of, and for an excitation
/// at a
///         natural frequency whose mode nothing damps: it names both frequencies
ForcedResponse forced_response(const DriveTrain& train);

/// Rows are inertias or elements, columns instants.
struct TrainMotion {
  Eigen::ArrayXd time_s;
  Eigen::ArrayXXd angle_rad, speed_rad_s, acceleration_rad_s2;  ///< per inertia
  Eigen::ArrayXXd torque_Nm, reduced_torque_Nm;                 ///< per element
};

/// The steady state in time. Angles leave the rigid acceleration and speed offset out, speeds leave the rigid
/// acceleration out; accelerations hold it, so that they balance the torques.
TrainMotion over_time(const DriveTrain& train, const ForcedResponse& response, const Eigen::ArrayXd& time_s);

/// A torque over time.
struct TransientLoad {
  std::string inertia;
  std::function<double(double time_s)> torque_Nm;
};

/// Torque that jumps from zero to torque_Nm at start_s.
std::function<double(double)> torque_step(double start_s, double torque_Nm);
/// Torque by straight lines between the entries, constant outside.
/// @throws MachineRefused if sizes differ, are zero, or time does not increase
std::function<double(double)> torque_table(std::vector<double> time_s, std::vector<double> torque_Nm);

struct TransientRun {
  double time_step_s = 0;
  long n_steps = 0;
  long store_every = 1;                   ///< every so many steps a column of the result
  bool with_excitations = true;           ///< the train's excitations, from t = 0
  std::vector<TransientLoad> loads;       ///< added to them
  Eigen::ArrayXd angle_rad, speed_rad_s;  ///< per inertia at t = 0; empty: zero
  double loss_frequency_rad_s = 0;  ///< loss factors act as viscous damping loss_factor C / this; > 0 if any
};

/// Energies belong to the columns of motion; kinetic + potential + dissipated - work is constant.
struct Transient {
  TrainMotion motion;
  Eigen::ArrayXd kinetic_J, potential_J, work_J, dissipated_J;
};

/// Average-acceleration Newmark method (trapezoidal rule): unconditionally stable, second order, and the
/// energy balance holds to round-off with the work of the mean torque on the midpoint speed.
/// @throws MachineRefused as natural_modes, and for a step that is not positive, wrong sizes, initial
///         values that contradict a rigid element or a held inertia, a loss factor without its frequency
Transient transient(const DriveTrain& train, const TransientRun& run);

/// An excitation line against the speed of the reference shaft: order * speed + constant.
struct ExcitationLine {
  std::string excitation;      ///< empty: a further order of a Campbell table, which no excitation has
  double order = 0;            ///< order by the speed of the reference shaft; zero: a constant frequency
  double frequency_rad_s = 0;  ///< at the train's mean speed
};

struct CampbellCrossing {
  ExcitationLine line;
  Eigen::Index mode = 0;
  double speed_rad_s = 0;  ///< speed of the reference shaft at the crossing
};

struct CampbellTable {
  Eigen::ArrayXd speed_rad_s;
  /// Elastic modes; torsion without gyroscopic terms: no speed in it.
  Eigen::ArrayXd natural_frequency_rad_s;
  std::vector<ExcitationLine> lines;
  Eigen::ArrayXXd line_frequency_rad_s;  ///< lines x speeds
  std::vector<CampbellCrossing> crossings;
};

/// Excitation lines against natural frequencies.
/// @param orders  further orders of the reference shaft, beside those of the excitations
/// @throws MachineRefused as natural_modes, and unless 0 <= slowest < fastest and n_speeds >= 2
CampbellTable campbell_table(const DriveTrain& train, double slowest_rad_s, double fastest_rad_s,
                             int n_speeds, const std::vector<double>& orders = {});

/// How far an excitation frequency lies from the natural frequency nearest to it.
struct ResonanceMargin {
  ExcitationLine line;
  Eigen::Index mode = 0;  ///< column of NaturalModes
  double natural_frequency_rad_s = 0;
  double margin = 0;         ///< frequency / natural frequency - 1: negative below the resonance
  double damping_ratio = 0;  ///< the mode's damping ratio from all kinds of damping; 0: nothing damps it
  /// Amplification with that damping: 1 / |1 - r^2 + 2 i zeta r|, r = frequency / natural frequency, as
  /// warnings state it.
  double amplification = 0;
};

/// One margin per excitation frequency at the mean speed, closest first.
std::vector<ResonanceMargin> resonance_margins(const DriveTrain& train);

/// Effects of a train: its excitations by name, then the kinds of damping that it has.
std::vector<EffectInfo> drive_train_effects(const DriveTrain& train);

/// The train with the named effects only: other excitations are left out, other damping is zero.
DriveTrain with_effects(const DriveTrain& train, const std::vector<std::string>& effects);

/// Steady state over the grid (turns of the reference shaft) under the named effects, and only those.
/// Excitations superpose and bring the contributions; a damping effect changes what they bring and has none
/// of its own.
///
/// Quantities: <inertia>.angle, <inertia>.acceleration, <element>.torque (on first),
/// <element>.reduced_torque, <element>.shear_stress where a diameter is given, rigid_acceleration, closure.
/// Resultants (torque only): "<element>_on_<inertia>" for both inertias of each element; where there is one,
/// "excitation_on_<inertia>" and "damping_on_<inertia>". All that act on one inertia add up to J phi''.
/// @throws MachineRefused as forced_response, for an effect unknown or named twice, or a wrong grid
LoadHistory compute_loads(const DriveTrain& train, const std::vector<std::string>& effects,
                          const TimeGrid& grid);

/// Name of the effect that all loads of a transient on one inertia are: "transient_torque_on_<inertia>".
std::string transient_torque_effect(const std::string& inertia);

/// Name of the effect that the initial angles and speeds of a transient are.
inline constexpr const char* initial_motion_effect = "initial_motion";

/// Loads over a transient, in the roles and quantities of compute_loads: a start from standstill, a blocked
/// disc. Instants are those that the run stores. The train is linear and so is the time stepping: each
/// excitation (where the run has them), the loads on each inertia together, and the initial values run alone;
/// they are the contributions, and what acts on one inertia adds up to J phi'' at every instant. Damping is
/// that of the named effects.
///
/// phi_rad, speed_rad_s and acceleration_rad_s2 are the true ones of the first inertia on the reference
/// shaft. <inertia>.angle is the true angle less mean_speed_rad_s times time, so that their sum, by which
/// forces are turned into a shaft's axes, is the integral of the true speed as in a steady state. There is no
/// rigid_acceleration: speeds and accelerations hold it.
/// @throws MachineRefused as transient, and for an effect unknown or named twice
LoadHistory compute_transient_loads(const DriveTrain& train, const std::vector<std::string>& effects,
                                    const TransientRun& run);

/// What Tables 4 and 7 of the paper print.
struct PublishedTable {
  Eigen::ArrayXd frequency_rad_s;   ///< falling, as printed (there as Hz); the rigid mode is left out
  Eigen::ArrayXXd mode;             ///< masses x modes, unit length, in the order of the table
  Eigen::ArrayXd forced_angle_rad;  ///< masses, in the order of the table
  /// (K - w^2 J)^-1 M: the same in Table 7; in Table 4 without its slip.
  Eigen::ArrayXd right_sign_angle_rad;
};

/// Convention `published`, to the letter, errata included, for a chain that is given from the motor on.
///   Table 4: reduced to the first shaft, a = -(K + w^2 J)^-1 M (18);
///   Table 7: reduced to the last shaft, masses in reverse order, a = (K - w^2 J)^-1 M, w times that ratio.
/// The belt's stiffness is the same number in both, torques are not reduced, w is the number of Hz of the one
/// harmonic of the excitations taken as rad/s, M has their amplitudes (in Table 7 with reversed sign).
/// @throws MachineRefused for a train with branches, rigid elements or without exactly one frequency
PublishedTable published_table_4(const DriveTrain& train);
PublishedTable published_table_7(const DriveTrain& train);

}  // namespace kinetics
