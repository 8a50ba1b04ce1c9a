/// Safety of a shaft against fatigue by DIN 743, from nominal stresses and shape factors: a second opinion
/// beside the local stresses of FKM.
///
/// Source: DIN 743-1 and 743-2 (2012). Equations and their numbers as in the public exercise program
/// engineering-standards-library (hanslhansl), which follows the standard. sigma_B and sigma_S are those at
/// the part's governing diameter (K_1 sigma_B(d_B) and K_1 sigma_S(d_B) of the standard). Fatigue strengths
/// follow from sigma_B as in 743-3: bending 0.5, tension and compression 0.4, torsion 0.3. Not taken over:
/// measured notch effects of keyways and press fits (743-2, table 1), hard surface layers, a relief by
/// compressive means (they count as zero, which is conservative).
#pragma once

namespace pipelines {

/// Something of tension or compression, of bending, and of torsion.
struct DinTriple {
  double tension = 0, bending = 0, torsion = 0;
};

/// Which way the stress grows when the part is overloaded.
enum class DinLoadCase {
  constant_mean,  ///< case 1: the amplitude alone grows
  constant_ratio  ///< case 2: mean and amplitude grow together; less safe than case 1 while safe
};

enum class DinSection { solid, hollow };

/// A section of a shaft with a notch round its circumference, or smooth.
struct DinShaft {
  double tensile_strength_Pa = 0;  ///< sigma_B(d)
  double yield_strength_Pa = 0;    ///< sigma_S(d), not above sigma_B
  double diameter_m = 0;           ///< d, of the notched section
  DinSection section = DinSection::solid;
  double roughness_m = 25e-6;       ///< R_z
  double treatment_factor = 1;      ///< K_V
  DinTriple shape_factor{1, 1, 1};  ///< alpha_sigma, alpha_tau on nominal stresses, >= 1
  DinTriple gradient_1_m;           ///< related stress gradient G' [1/m], >= 0
};

/// Nominal stresses [Pa]: amplitudes >= 0; means signed.
struct DinLoad {
  DinTriple amplitude_Pa, mean_Pa;
  DinLoadCase load_case = DinLoadCase::constant_ratio;
};

/// Size factor of bending and torsion: 1 - 0.2 lg(d/7.5 mm) / lg 20, 1 below 7.5 mm, 0.8 from 150 mm; of
/// tension it is 1. Source: DIN 743-2, eq. (15) and (16).
double din_size_factor(double diameter_m);

/// Roughness factor K_F,sigma = 1 - 0.22 lg(R_z/um) (lg(sigma_B / 20 MPa) - 1), at most 1; of torsion 0.575
/// K_F,sigma + 0.425. Source: DIN 743-2, eq. (18) and (19).
double din_roughness_factor(double roughness_m, double tensile_strength_Pa);

/// Support number n = 1 + sqrt(G' mm) 10^-(0.33 + sigma_S / 712 MPa); beta = alpha / n. Source: DIN 743-2,
/// 4.3.1.
double din_support_number(double gradient_1_m, double yield_strength_Pa);

/// What the safety is made of.
struct DinSafety {
  DinTriple notch_effect;  ///< beta_sigma, beta_tau = alpha / n, at least 1
  DinTriple total_factor;  ///< K = (beta / K_2 + 1 / K_F - 1) / K_V, eq. (8), (9)
  DinTriple reversed_Pa;   ///< sigma_zdWK, sigma_bWK, tau_tWK, eq. (5) to (7)
  DinTriple sensitivity;   ///< psi = sigma_WK / (2 sigma_B - sigma_WK), eq. (20) to (22)
  DinTriple yield_Pa;      ///< sigma_FK = K_2F gamma_F sigma_S, tau_FK = K_2F sigma_S / sqrt(3), (31), (32)
  double mean_equivalent_Pa = 0;  ///< sigma_mv, eq. (23); tau_mv = sigma_mv / sqrt(3), eq. (24)
  DinTriple amplitude_Pa;         ///< sigma_ADK, eq. (10) to (19); zero where the mean alone yields
  double fatigue = 0;   ///< S = 1 / sqrt((s_zda/s_zdADK + s_ba/s_bADK)^2 + (t_ta/t_tADK)^2), eq. (2)
  double yielding = 0;  ///< the same of amplitude plus mean over sigma_FK, eq. (25)
};

/// Safety against fatigue and against yielding; infinite without amplitudes, without stress. DIN asks
/// for 1.2. The endured amplitude is sigma_WK - psi sigma_mv in case 1 and sigma_WK / (1 + psi sigma_mv /
/// sigma_a) in case 2, and at most what reaches the yield strength. In case 2 each kind of stress that
/// alternates at all would count the whole mean once more, be it 1 Pa: below a hundredth of the equivalent
/// amplitude it counts it in proportion (sigma_a in sigma_mv / sigma_a is at least that hundredth), so that
/// the safety has no jump. The standard has no such bound.
/// @throws std::invalid_argument if a strength, the diameter, R_z or K_V is not positive, the yield strength
/// is
///         above the tensile strength, a shape factor below 1, a gradient or an amplitude negative, or a
///         value not finite
DinSafety din_743_safety(const DinShaft& shaft, const DinLoad& load);

}  // namespace pipelines
