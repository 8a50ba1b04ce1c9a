/// Load table: loads that the user brings, measured or computed elsewhere, as a load history.
///
/// A load is a column of samples over time or over the drive's angle, or a constant with one harmonic. What
/// is sampled covers whole turns of the drive, is taken as periodic, and is resampled to the instants of the
/// grid; how far that changes it is stated.
#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "kinetics/values/load_history.h"

namespace kinetics {

/// Samples over the period; they need not be equidistant.
struct SampledCourse {
  /// Drive angles, strictly ascending, at least four; they span at most the period.
  Eigen::ArrayXd angle_rad;
  Eigen::ArrayXd values;  ///< SI unit of the component
  std::string origin{};   ///< where the samples come from and how they were read, for people; may be empty
};

/// value(phi) = mean + amplitude cos(order phi - phase), phi from the first instant
struct HarmonicCourse {
  double mean = 0, amplitude = 0;  ///< SI unit of the component
  double order = 1;                ///< periods per turn of the drive, >= 0; order x turns must be whole
  double phase_rad = 0;
};

struct TableLoad {
  std::string effect;     ///< the effect it belongs to; several loads may share one
  std::string port;       ///< where it enters a body: the role of the resultant
  std::string component;  ///< "fx", "fy" [N], "torque" [N m]: part of a resultant; any other: a quantity
  std::string unit;       ///< SI unit of any other component
  std::variant<SampledCourse, HarmonicCourse> course;
};

struct LoadTable {
  double speed_rad_s = 0;  ///< speed of the drive, > 0: ties time and angle together
  std::vector<TableLoad> loads;
  int turns = 1;  ///< turns after which the samples repeat, where the user says so; else a grid says it
};

/// What making a load periodic and resampling it has changed, in the unit of the load.
struct ResamplingError {
  std::string effect, port, component;
  double largest = 0;  ///< largest value of the samples, for comparison
  /// Jump between the end of the period and its beginning, beyond the usual step of the samples.
  double jump = 0;
  /// Largest miss where every second sample is interpolated from its neighbours: an upper estimate of what
  /// interpolation adds.
  double between = 0;
};

/// One per effect of the table, in the order in which they first occur.
std::vector<EffectInfo> load_table_effects(const LoadTable& table);

/// Sampled loads only, in the order of the table.
std::vector<ResamplingError> resampling_errors(const LoadTable& table, const TimeGrid& grid);

/// Angles of the drive at which a sample of the named effects' loads lies between two instants and is off the
/// straight line through their values by more than 0.1 % of the largest sample: what the instants alone do
/// not tell, a spike between two of them. Of many those that are furthest off, ascending; none: empty.
/// @throws MachineRefused as compute_loads
Eigen::ArrayXd samples_passed_over(const LoadTable& table, const std::vector<std::string>& effects,
                                   const TimeGrid& grid, Eigen::Index most = 4096);

/// Angles of a whole course that knows what loads do between the instants where samples change by more than a
/// fifth of the largest from one instant to the next (a square wave, a shock of few samples): sixteen from
/// each sample or instant to the next, four where more than `most` would be needed, the instants among them.
/// No spectrum of the instants tells such a course, but the cubic between samples is the load. None: no such
/// samples, or too many angles even so.
/// @throws MachineRefused as compute_loads
Eigen::ArrayXd course_of_rough_samples(const LoadTable& table, const std::vector<std::string>& effects,
                                       const TimeGrid& grid, Eigen::Index most = 4096);

/// What lives do not know, however well the largest load is known: samples between two instants that are
/// beyond both of their values by more than 20 % of the largest, of which whole cycles may lie there. One
/// sentence for each such load.
/// @throws MachineRefused as compute_loads
std::vector<std::string> warnings_of_cycles(const LoadTable& table, const std::vector<std::string>& effects,
                                            const TimeGrid& grid);

/// The loads at other angles than the instants of the grid: as compute_loads, without warnings.
/// @param phi_rad  over grid.turns, which are the period of the samples
/// @throws MachineRefused as compute_loads, but for instants that miss samples
LoadHistory loads_at(const LoadTable& table, const std::vector<std::string>& effects, const TimeGrid& grid,
                     const Eigen::ArrayXd& phi_rad);

/// Evaluates the loads of the named effects over the grid; grid.turns is the period of the samples.
///
/// Between samples a cubic of Fritsch and Carlson (1980): smooth, and never beyond the samples on either
/// side. One resultant per port, one contribution per effect; other components become quantities
/// "<port>.<component>". Samples are not turned: they mean the frame that their port means. A jump at the
/// seam above 1 % of the largest value, interpolation above 1 %, and instants that miss the largest or the
/// smallest sample by more than 3 % of the largest are warned of.
/// @throws MachineRefused naming parameter, value and remedy: no load, an unknown effect, NaN or
///         infinity, fewer than four samples, angles that do not ascend or span more than the period, samples
///         that leave more than half a turn uncovered where the period closes or two thirds of one elsewhere,
///         instants that miss the largest sample by more than 10 % of it (less is told by
///         samples_passed_over), an order that does not fit the period or that two instants per period or
///         fewer would alias, speed not positive, the same load twice in one effect
LoadHistory compute_loads(const LoadTable& table, const std::vector<std::string>& effects,
                          const TimeGrid& grid);

}  // namespace kinetics
