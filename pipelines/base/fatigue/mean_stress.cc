#include "pipelines/base/fatigue/mean_stress.h"

#include <algorithm>
#include <cmath>

#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

void require_cycle(const CyclicStress& stress) {
  require_non_negative_input("amplitude_Pa", stress.amplitude_Pa);
  require_finite_input("mean_Pa", stress.mean_Pa);
}

}  // namespace

MeanStressSafety mean_stress_safety(const CyclicStress& stress, const MeanStressStrength& strength) {
  require_cycle(stress);
  require_positive_input("endurance_Pa", strength.endurance_Pa);
  require_positive_input("tensile_strength_Pa", strength.tensile_strength_Pa);
  require_positive_input("yield_strength_Pa", strength.yield_strength_Pa);
  if (strength.yield_strength_Pa > strength.tensile_strength_Pa)
    refuse_fatigue_input("yield_strength_Pa", strength.yield_strength_Pa,
                         "must not be above tensile_strength_Pa");
  const double tension_Pa = std::max(0.0, stress.mean_Pa);
  const double a = stress.amplitude_Pa / strength.endurance_Pa;
  const double to_tensile = tension_Pa / strength.tensile_strength_Pa;
  const double to_yield = tension_Pa / strength.yield_strength_Pa;
  MeanStressSafety safety;
  safety.goodman = 1 / (a + to_tensile);
  safety.gerber = 2 / (a + std::hypot(a, 2 * to_tensile));  // table 6-7, without its 0/0 at zero mean
  safety.soderberg = 1 / (a + to_yield);
  safety.asme_elliptic = 1 / std::hypot(a, to_yield);
  safety.yield = strength.yield_strength_Pa / (stress.amplitude_Pa + std::abs(stress.mean_Pa));
  return safety;
}

double mean_stress_sensitivity(double tensile_strength_Pa, double a_M, double b_M, double shear_factor) {
  require_positive_input("tensile_strength_Pa", tensile_strength_Pa);
  require_finite_input("a_M", a_M);
  require_finite_input("b_M", b_M);
  require_input_between("shear_factor", shear_factor, 0, 1);
  const double sensitivity = shear_factor * std::max(0.0, a_M * 1e-3 * tensile_strength_Pa / 1e6 + b_M);
  if (sensitivity >= 1)
    refuse_fatigue_input("mean-stress sensitivity M", sensitivity,
                         "must be below 1; tensile_strength_Pa is beyond the material group");
  return sensitivity;
}

HaighField haigh_field(const CyclicStress& stress) {
  require_cycle(stress);
  if (stress.mean_Pa < -stress.amplitude_Pa) return HaighField::compression;
  if (stress.mean_Pa <= stress.amplitude_Pa) return HaighField::alternating;
  if (stress.mean_Pa < 3 * stress.amplitude_Pa) return HaighField::pulsating_tension;
  return HaighField::high_static_tension;
}

double haigh_factor(const CyclicStress& stress, double sensitivity) {
  require_non_negative_input("mean-stress sensitivity M", sensitivity);
  if (sensitivity >= 1) refuse_fatigue_input("mean-stress sensitivity M", sensitivity, "must be below 1");
  const double M = sensitivity;
  const double x = stress.amplitude_Pa > 0 ? stress.mean_Pa / stress.amplitude_Pa : 0;
  switch (haigh_field(stress)) {
    case HaighField::compression:
      return 1 / (1 - M);
    case HaighField::alternating:
      return 1 / (1 + M * x);
    case HaighField::pulsating_tension:
      return (1 + M / 3) / (1 + M) / (1 + M * x / 3);
    case HaighField::high_static_tension:
      break;
  }
  return (1 + M / 3) / ((1 + M) * (1 + M));
}

double equivalent_reversed_amplitude_Pa(const CyclicStress& stress, double sensitivity) {
  return stress.amplitude_Pa / haigh_factor(stress, sensitivity);
}

EquivalentAmplitudeSlopes equivalent_amplitude_slopes(const CyclicStress& stress, double sensitivity) {
  const double M = sensitivity, pulsating = (1 + M) / (1 + M / 3);
  switch (haigh_field(stress)) {
    case HaighField::compression:
      return {1 - M, 0};
    case HaighField::alternating:
      return {1, M};
    case HaighField::pulsating_tension:
      return {pulsating, pulsating * M / 3};
    case HaighField::high_static_tension:
      break;
  }
  return {pulsating * (1 + M), 0};
}

}  // namespace pipelines
