/// Fatigue life of rolling bearings under a load that varies over a cycle.
///
/// Source: ISO 281:2007 (basic rating life); Shigley's Mechanical Engineering Design, ch. 11 (Weibull
/// reliability). Loads are dynamic equivalent loads of the bearing, radial and axial parts already combined.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace kinetics {

enum class RollingElement { ball, roller };

/// Exponent p of the life curve L10 = (C / P)^p: 3 for balls, 10/3 for rollers (ISO 281).
double life_exponent(RollingElement element);

/// Equivalent constant load of a load history over one cycle, P = (mean |F|^p)^(1/p).
/// @param force_N  force at equidistant instants of a shaft that turns steadily, at least one; the sign does
///                 not count
/// @return P [N], zero only if the bearing is never loaded
/// @throws MachineRefused if the history is empty, or holds NaN or infinity
double equivalent_load_N(const Eigen::ArrayXd& force_N, RollingElement element);

/// The same where the instants stand for unequal numbers of revolutions (run-up, load spectrum).
/// @param revolutions  weight of each force, >= 0, their sum positive; any common factor cancels
/// @throws MachineRefused as above, or if the sizes differ, a weight is negative or all are zero
double equivalent_load_N(const Eigen::ArrayXd& force_N, const Eigen::ArrayXd& revolutions,
                         RollingElement element);

/// Basic rating life: what 90 % of a large number of bearings reach.
struct RatingLife {
  double million_revolutions = 0;  ///< L10
  double hours = 0;                ///< L10h
};

/// L10 = (C / P)^p [1e6 revolutions] and L10h = 1e6 L10 / (3600 speed / 2 pi) [h].
/// @param dynamic_rating_N   [C] > 0, by the bearing's catalogue
/// @param equivalent_load_N  [P] >= 0
/// @param speed_rad_s        speed of the inner against the outer ring, > 0
/// @return empty where no life follows: without load a bearing does not fatigue (and the same for a load so
///         small that the life exceeds what a double can hold); never infinity
/// @throws MachineRefused if an argument is not finite or out of its range
std::optional<RatingLife> rating_life(double dynamic_rating_N, double equivalent_load_N,
                                      RollingElement element, double speed_rad_s);

/// Life that a share of bearings reaches over what 90 % reach, a1 = 0.95 (ln(1/S) / ln(1/0.9))^(2/3) + 0.05:
/// the law behind the table of ISO 281:2007 (its Table 12 rounds it to two digits).
/// @param reliability  S, 0.9 to 0.9995 as in the table
/// @throws MachineRefused outside
double life_factor(double reliability);

/// Film, dirt and the load below which nothing fatigues.
struct Lubrication {
  double viscosity_ratio = 0;  ///< [kappa] >= 0.1, of the oil to what the film needs; above 4 it counts as 4
  double contamination_factor = 0;  ///< [e_C] in (0, 1], 1: clean
  double fatigue_load_limit_N = 0;  ///< [C_u] > 0, by the bearing's catalogue
};

/// Life modification factor a_ISO of radial bearings, by ISO 281:2007, equations (31) to (36):
///   a_ISO = 0.1 (1 - g(kappa) (e_C C_u / P)^n)^-m, at most 50.
/// @param equivalent_load_N  P > 0
/// @throws MachineRefused if an argument is not finite or out of its range
double life_modification_factor(const Lubrication& lubrication, double equivalent_load_N,
                                RollingElement element);

/// Life of a bearing in units of L10 at the rating load: R = exp(-((x - x0) / (theta - x0))^b).
/// The defaults are those of many catalogues; they give R = 0.9 at x = 0.9933 rather than at 1 because they
/// are rounded.
struct WeibullLife {
  double guaranteed = 0.02;    ///< [x0] >= 0: no bearing fails earlier
  double scale = 4.439;        ///< [theta - x0] > 0
  double shape = 1.483;        ///< [b] > 0
  double life_exponent = 3.0;  ///< [a] > 0, 3 for balls, 10/3 for rollers
};

/// Multiples x_D of 1e6 revolutions that a required life amounts to.
/// @throws MachineRefused if an argument is not positive
double required_million_revolutions(double hours, double speed_rad_s);

/// Dynamic rating that reaches a required life with a required reliability,
///   C10 = F (x_D / (x0 + (theta - x0) (ln 1/R)^(1/b)))^(1/a).
/// @param load_N               F >= 0, equivalent load with its application factor
/// @param million_revolutions  x_D > 0
/// @param reliability          R, 0 < R <= 1; 1 only if the law has a guaranteed life
/// @throws MachineRefused if an argument is not finite or out of its range
double required_rating_N(double load_N, double million_revolutions, double reliability,
                         const WeibullLife& law = {});

/// Reliability of a bearing of a given rating, the inverse of required_rating_N; 1 below the guaranteed life.
/// @param rating_N  C10 > 0
/// @throws MachineRefused if an argument is not finite or out of its range
double reliability(double load_N, double million_revolutions, double rating_N, const WeibullLife& law = {});

}  // namespace kinetics
