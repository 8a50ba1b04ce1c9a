/// Constants of the FKM guideline by material group, and the material of a part.
///
/// Source: Forschungskuratorium Maschinenbau, FKM guideline Analytical Strength Assessment of Components, 6th
/// ed. (2012), local stresses: factors of the fatigue limit 4.2.1, roughness constant K_f~ 4.3.1.2, support
/// factor 4.3.1.3.1 (after Stieler), roughness 4.3.1.4, mean-stress sensitivity 4.4.2.1.2, component S-N
/// curve 4.4.3. The numbers are quoted from public texts: pyLife (Robert Bosch GmbH),
/// strength/fkm_linear/constants.py, which names the 2012 edition; a_R and R_m,N,min also at
/// quadco.engineering, "Surface roughness factor"; slopes from McKelvey, Lee and Barkey, J. Fail. Anal. Prev.
/// 12 (2012) 445-484.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pipelines {

enum class MaterialGroup {
  steel,  ///< other than the three below
  stainless_steel,
  case_hardening_steel,
  forging_steel,
  cast_steel,           ///< GS
  ductile_cast_iron,    ///< GGG, GJS
  malleable_cast_iron,  ///< GT, GJM
  grey_cast_iron,       ///< GG, GJL
  wrought_aluminium,
  cast_aluminium
};

/// What FKM says of a group. Strengths in the guideline's formulas are in MPa, gradients in 1/mm, R_z in um.
struct GroupConstants {
  MaterialGroup group;
  const char* name;  ///< as in scenes: "steel", "stainless steel" ...

  /// Fatigue limits of the smooth specimen at R = -1 and N = 1e6, survival 97.5 %:
  /// sigma_W = f_W,sigma R_m in tension and compression, tau_W = f_W,tau sigma_W. (4.2.1)
  double f_W_sigma, f_W_tau;
  double a_M, b_M;                  ///< M_sigma = a_M 1e-3 R_m + b_M
  double a_R_sigma, R_m_N_min_MPa;  ///< K_R = 1 - a_R lg(R_z) lg(2 R_m / R_m,N,min)
  double a_G, b_G_MPa;              ///< exponent of the support factor, endurance.h
  double K_f_estimate;              ///< K_f~: how much of the roughness a notch leaves, endurance.h
  bool is_cast;                     ///< asks for a casting factor
  bool is_grey_or_malleable;        ///< counts as less ductile than 12.5 % elongation, whatever is measured

  /// S-N curve of normal stress in unwelded parts: knee N_D = 1e6 and slope k; then horizontal (type I), or
  /// falling on with second_slope to 1e8 (type II: aluminium and austenitic steel).
  double slope, knee_cycles;
  std::optional<double> second_slope;
};

/// Constants of all groups, in the order of the enumeration.
const std::vector<GroupConstants>& material_groups();

const GroupConstants& constants_of(MaterialGroup group);

/// The material of a part, of its size: the strengths of the drawing's standard at the governing diameter,
/// with the technological size factor K_d in them.
struct FatigueMaterial {
  MaterialGroup group = MaterialGroup::steel;
  double tensile_strength_Pa = 0;    ///< R_m
  double yield_strength_Pa = 0;      ///< R_p, R_e or R_p0.2
  std::optional<double> elongation;  ///< A_5 at fracture, as a ratio (0.15 is 15 %); without: not checked
};

/// @throws std::invalid_argument if a strength is not positive, yield is above tensile strength, R_m above
///         3000 MPa (taken for a wrong unit), or the elongation is outside 0 to 1
void require_sound(const FatigueMaterial& material);

/// sigma_W,zd = f_W,sigma R_m: amplitude of normal stress that the smooth specimen endures at R = -1 [Pa].
double reversed_strength_Pa(const FatigueMaterial& material);

}  // namespace pipelines
