/// How a mean stress changes the amplitude that is endured: the lines of Shigley's textbook (Goodman, Gerber,
/// Soderberg, ASME elliptic, Langer) and the Haigh diagram of the FKM guideline.
///
/// Stresses are those at the place that is assessed, notch effect included; tension is positive. Safety is
/// the factor on amplitude and mean together (constant stress ratio) at which the line is reached; it is
/// infinite without stress.
#pragma once

namespace pipelines {

/// A cycle of a scalar stress.
struct CyclicStress {
  double amplitude_Pa = 0;  ///< half of maximum minus minimum, >= 0
  double mean_Pa = 0;       ///< half of maximum plus minimum, signed
};

/// What the lines of Shigley's textbook need of a material.
struct MeanStressStrength {
  double endurance_Pa = 0;         ///< S_e, amplitude endured at zero mean with all factors of the part, > 0
  double tensile_strength_Pa = 0;  ///< S_ut, > 0
  double yield_strength_Pa = 0;    ///< S_y, > 0 and not above S_ut
};

/// Safety against endurance by each line, and against first-cycle yielding. Compressive means count as zero
/// (conservative; Shigley's diagram is horizontal there), but not against yielding.
/// Source: Budynas and Nisbett, Shigley's Mechanical Engineering Design, 9th ed., 6-12: Soderberg eq. (6-45),
/// Goodman (6-46), Gerber (6-47 and table 6-7), ASME elliptic (6-48 and table 6-8), Langer (6-49).
struct MeanStressSafety {
  double goodman = 0;        ///< 1/n = sigma_a/S_e + sigma_m/S_ut
  double gerber = 0;         ///< n sigma_a/S_e + (n sigma_m/S_ut)^2 = 1
  double soderberg = 0;      ///< 1/n = sigma_a/S_e + sigma_m/S_y; the lowest of the four
  double asme_elliptic = 0;  ///< (n sigma_a/S_e)^2 + (n sigma_m/S_y)^2 = 1
  double yield = 0;          ///< n_y = S_y / (sigma_a + |sigma_m|)
};

/// @throws std::invalid_argument if an amplitude is negative, a strength is not positive, the yield strength
///         is above the tensile strength, or a value is not finite
MeanStressSafety mean_stress_safety(const CyclicStress& stress, const MeanStressStrength& strength);

/// Mean-stress sensitivity M of FKM: how much the endured amplitude falls from R = -1 to R = 0.
///   M_sigma = a_M 1e-3 R_m / MPa + b_M,  M_tau = f_W,tau M_sigma  (pass shear_factor = f_W,tau)
/// A negative value (soft steel) counts as zero, which is conservative in tension.
/// Source: FKM guideline Analytical Strength Assessment, 6th ed. (2012), 4.4.2.1.2; also as in pyLife's
/// fkm_linear.
/// @param a_M, b_M      of the material group (fatigue_material.h)
/// @param shear_factor  1 for normal stress, f_W,tau for shear stress
/// @throws std::invalid_argument if the strength is not positive or the result is not below 1
double mean_stress_sensitivity(double tensile_strength_Pa, double a_M, double b_M, double shear_factor = 1);

/// Fields of FKM's Haigh diagram, by stress ratio R = minimum / maximum.
enum class HaighField {
  compression,         ///< I: R > 1, the whole cycle is compressive
  alternating,         ///< II: -infinity <= R <= 0, slope M
  pulsating_tension,   ///< III: 0 < R < 0.5, slope M / 3
  high_static_tension  ///< IV: R >= 0.5, no further fall
};

/// @throws std::invalid_argument if the amplitude is negative or a value is not finite
HaighField haigh_field(const CyclicStress& stress);

/// Mean-stress factor K_AK of FKM for overload case F2 (stress ratio stays constant when the load grows):
/// endured amplitude over that at R = -1. With x = sigma_m / sigma_a:
///   I: 1 / (1 - M);  II: 1 / (1 + M x);  III: (1 + M/3) / (1 + M) / (1 + M x / 3);
///   IV: (1 + M/3) / (1 + M)^2
/// It is continuous at x = -1, 1 and 3. A zero amplitude is in field IV (tension) or I (compression), and in
/// II without any stress. Shear stress has no compressive side: give |tau_m|. Source: FKM guideline, 6th
/// ed., 4.4.2 (mean-stress factor, overload case F2).
/// @param sensitivity  M, 0 <= M < 1
/// @throws std::invalid_argument as haigh_field, or if M is outside its range
double haigh_factor(const CyclicStress& stress, double sensitivity);

/// Amplitude at R = -1 that does the same damage: sigma_a / K_AK.
double equivalent_reversed_amplitude_Pa(const CyclicStress& stress, double sensitivity);

/// Derivatives of equivalent_reversed_amplitude_Pa, which in each field is linear in amplitude and mean.
struct EquivalentAmplitudeSlopes {
  double by_amplitude = 1, by_mean = 0;
};
/// Slopes of the equivalent amplitude; on a border those of the field that haigh_field names.
EquivalentAmplitudeSlopes equivalent_amplitude_slopes(const CyclicStress& stress, double sensitivity);

}  // namespace pipelines
