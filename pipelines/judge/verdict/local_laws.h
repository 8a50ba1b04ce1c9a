/// How stress changes with a dimension next to it, under the same loads: the radius of a fillet, the
/// thickness of a plate. Estimates: what the changed part does to the loads elsewhere is left out.
#pragma once

#include <functional>
#include <optional>

#include "pipelines/base/fatigue/din_743.h"
#include "pipelines/superpose/envelope/superposition.h"

namespace pipelines {

/// What a place bears with a dimension of that size [m], in any unit; empty: the same with all.
using StrengthBySize = std::function<double(double)>;

/// A shoulder of a solid round shaft.
struct ShoulderSize {
  double small_m = 0, large_m = 0;  ///< diameters
  double fillet_m = 0;
};

/// The least radius at which the stress in a fillet over its strength is less by a factor: by the published
/// notch factors (fem/models/beam/fillet_factors.h), stress(r) / stress(now) = K(r) / K(now).
/// @param nominal_Pa  of the thinner section; they say how much the factor of each kind of load counts
/// @param factor      above 1
/// @return none: no radius below the shoulder's height does it
std::optional<double> radius_for(const ShoulderSize& shoulder, const DinTriple& nominal_Pa, double factor,
                                 const StrengthBySize& strength = {});

/// Stress at a face of a plate by its parts through the thickness, [Pa]: they add up to it.
struct PlateStress {
  Stress membrane{}, bending{};
};

/// From both faces: the mean and half of the difference.
PlateStress plate_stress(const Stress& face_Pa, const Stress& opposite_Pa);

/// Beyond twice the thickness, eight times the bending stiffness, no load stays where it was.
inline constexpr double thickest = 2;

/// The least thickness at which the von Mises stress at the face over the strength there is less by a factor:
///   sigma(t) = (membrane t0/t + bending (t0/t)^2) (1 - own + own t/t0)
/// It is never taken to fall faster than bending alone: where both parts oppose, the other face leads.
/// @param thickness_m  present, t0
/// @param own_share    share of the stress that the accelerated mass of the plate itself brings: it grows
/// with the thickness
/// @param factor       above 1
/// @return none: none up to `thickest` times the present one does it
std::optional<double> thickness_for(const PlateStress& stress, double thickness_m, double own_share,
                                    double factor, const StrengthBySize& strength = {});

/// Two digits, rounded up or down [m, shown in mm].
double two_digits_up_m(double size_m);
double two_digits_down_m(double size_m);

}  // namespace pipelines
