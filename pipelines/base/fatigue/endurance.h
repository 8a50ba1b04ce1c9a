/// Fatigue limit of a place: FKM's for local stresses, and Shigley's for shafts with Marin's factors.
///
/// FKM's limits hold for 97.5 % survival, up to 100 degrees Celsius (60 for fine-grain steel), without
/// corrosion. Shigley's mean strengths hold for 50 %.
#pragma once

#include "pipelines/base/fatigue/fatigue_material.h"
#include "pipelines/base/fatigue/mean_stress.h"

namespace pipelines {

enum class StressKind { normal, shear };

/// Surface and treatment of a place. The defaults: machined (R_z 25 um), untreated.
struct SurfaceState {
  double roughness_m = 25e-6;   ///< mean height R_z; FKM takes 200 um for skins of casting and rolling
  double treatment_factor = 1;  ///< K_V: hardened or rolled layers, 1 to 2.5 (FKM 4.3.3)
  double coating_factor = 1;    ///< K_S: protective layer on aluminium, 0.5 to 1 (FKM 4.3.4)
  double grey_iron_factor = 1;  ///< K_NL,E: bending of grey cast iron, 1 to 1.075 (FKM 4.3.5); 1 is safe
};

/// Support factor n of FKM by the related stress gradient G (after Stieler): the steeper the stress falls
/// below the surface, the more the surface endures. With e = a_G + f R_m / b_G, f = 1 (normal) or f_W,tau
/// (shear):
///   G <= 0.1/mm: 1 + (G mm) 10^-(e - 0.5);  to 1/mm: 1 + sqrt(G mm) 10^-e;  to 100/mm: 1 + (G mm)^(1/4)
///   10^-e
/// The three agree at their borders. Beyond 100/mm the value of 100/mm is kept: the guideline ends there.
/// Source: FKM guideline, 6th ed., 4.3.1.3.1.
/// @param gradient_1_m  G = -(1/sigma) d sigma / d depth, >= 0 [1/m]; 2/d for a smooth bar in bending
/// @throws std::invalid_argument if the gradient is negative or not finite, or by require_sound(material)
double support_factor(const FatigueMaterial& material, StressKind kind, double gradient_1_m);

/// Roughness factor K_R = 1 - a_R lg(R_z/um) lg(2 R_m / R_m,N,min), a_R,tau = f_W,tau a_R,sigma; at most 1.
/// Source: FKM guideline, 6th ed., 4.3.1.4.
/// @throws std::invalid_argument if R_z is not positive or above 1 mm, or the factor falls below 0.1
double roughness_factor(const FatigueMaterial& material, StressKind kind, double roughness_m);

/// FKM's fatigue limit of a place, and all that it is made of.
struct EnduranceLimit {
  double support = 1;        ///< n
  double roughness = 1;      ///< K_R
  double design_factor = 1;  ///< K_WK = (1 + (1/K_R - 1)/K_f~) / (n K_V K_S K_NL,E), eq. of 4.3.1.1
  double reversed_Pa = 0;    ///< sigma_WK = sigma_W / K_WK, at R = -1
  double mean_stress_sensitivity = 0;
  double mean_stress_factor = 1;  ///< K_AK, overload case F2
  double amplitude_Pa = 0;        ///< sigma_AK = K_AK sigma_WK
  double utilisation = 0;         ///< sigma_a j_D / sigma_AK, endured up to 1
};

/// Fatigue limit of a local stress. Steps: sigma_W of the group, design factor of gradient and surface, mean
/// stress. Without an amplitude the utilisation is zero, with the limit of field IV, I or II.
/// Source: FKM guideline, 6th ed., 4.3.1.1 (K_WK), 4.4.2 (sigma_AK), 4.6 (utilisation).
/// @param stress         local stress; the mean of shear counts by its size
/// @param safety_factor  j_D, >= 1, see required_safety
/// @throws std::invalid_argument as support_factor, roughness_factor and haigh_factor; if K_V is outside 0.5
/// to
///         3, K_S outside 0.3 to 1, K_NL,E outside 1 to 1.1, or j_D outside 1 to 10
EnduranceLimit endurance_limit(const FatigueMaterial& material, StressKind kind, double gradient_1_m,
                               const SurfaceState& surface, const CyclicStress& stress, double safety_factor);

enum class Consequences { severe, moderate };
enum class Inspection { none, regular };
enum class Casting { not_cast, tested, untested };  ///< tested: every part, without destroying it

/// Safety factor j_D = j_F j_G + Delta j against the fatigue limit:
///   j_F: 1.5 severe, 1.3 moderate; with regular inspection 1.35 and 1.2
///   j_G: castings 1.25 tested, 1.4 untested; else 1
///   Delta j = 0.5 - sqrt(A_5 / 50 %) for less than 12.5 % elongation (ductile iron), and 0.5 for grey and
///   malleable iron. An elongation that is not known costs ductile iron the full 0.5.
/// The published products are rounded: 2.1, 1.8, 1.9, 1.7 untested, 1.9, 1.65, 1.7, 1.5 tested. Loads are
/// taken as safe (j_S = 1). Source: FKM guideline, 5th ed., 4.5 with tables 4.5.1 to 4.5.3 (quoted in Lee,
/// Barkey and Kang, Metal Fatigue Analysis Handbook, 2012, 4.4); the 6th edition states j_G apart.
/// @throws std::invalid_argument if a cast group is said to be not cast, or the other way round
double required_safety(const FatigueMaterial& material, Consequences consequences, Inspection inspection,
                       Casting casting);

/// Factor on a strength with 97.5 % survival for another one: (1 - 0.08 z(R)) / (1 - 0.08 z(0.975)), z from
/// the normal law. FKM has no such factor for unwelded parts: the 8 % scatter is that of Shigley's k_e.
/// @param reliability  0.5 to 0.999999
/// @throws std::invalid_argument if the reliability is outside its range
double reliability_factor_of_97_5(double reliability);

/// Shigley's reliability factor k_e = 1 - 0.08 z(R): 1 at 50 %, 0.897 at 90 %, 0.814 at 99 %, 0.702 at 99.99
/// %. Source: Shigley, 9th ed., eq. (6-29) and table 6-5.
/// @throws std::invalid_argument if the reliability is outside 0.5 to 0.999999
double marin_reliability_factor(double reliability);

}  // namespace pipelines
