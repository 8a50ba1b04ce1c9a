/// Stress concentration of a shoulder fillet in a solid round shaft, by published fits of photoelastic tests.
#pragma once

namespace fem {

/// Factors on the nominal stress of the smaller diameter d: 4 F / pi d^2, 32 M / pi d^3, 16 T / pi d^3.
struct FilletFactors {
  double tension = 1, bending = 1, torsion = 1;
};

/// Largest distance of the fits from the elastic solution over the public reference cases P08 and P09
/// (D/d 1.1 to 2, r/d 0.05 to 0.2), relative: tension lies 8 to 17 % below it, bending 0 to 7 % below,
/// torsion within 3 % on both sides. tests/unit/fem/models/beam/fillet_factors.cc holds them.
inline constexpr FilletFactors fillet_factor_error{0.17, 0.07, 0.03};

/// K = C1 + C2 t + C3 t^2 + C4 t^3,  t = 2 h / D,  h = (D - d) / 2,  Ci = a + b sqrt(h/r) + c h/r.
/// Source: Pilkey and Pilkey, Peterson's Stress Concentration Factors, charts 3.4, 3.10, 3.12; coefficients
/// as the public verification cases P08 and P09 quote them. Valid for h/r from 0.1 to 20 (torsion: 0.25 to
/// 4). Outside, DIN 743-2:
///   K = 1 + 1 / sqrt(A r/h + 2 B r/d (1 + 2 r/d)^2 + C (r/h)^z d/D);
/// where the two meet, K jumps by some per cent. Never below 1.
/// @param small_diameter_m, large_diameter_m  d, D [m], 0 < d < D
/// @param fillet_m  radius r [m], > 0
/// @throws std::invalid_argument for other sizes
FilletFactors fillet_factors(double small_diameter_m, double large_diameter_m, double fillet_m);

}  // namespace fem
