#include "pipelines/base/fatigue/din_743.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

/// Increase of the yield strength by the constraint of a notch round the circumference, DIN 743-1, table 2.
double constraint_of_notch(double shape_factor) {
  if (shape_factor < 1.5) return 1;
  if (shape_factor < 2) return 1.05;
  return shape_factor < 3 ? 1.1 : 1.15;
}

/// One kind of stress of a shaft.
struct DinKind {
  double of_tensile_strength, shape_factor, gradient_1_m, size, roughness;
};
struct DinLimit {
  double notch_effect, total_factor, reversed_Pa, sensitivity;
};

DinLimit limit_of_kind(const DinKind& kind, const DinShaft& shaft) {
  DinLimit limit{};
  limit.notch_effect =
      std::max(1.0, kind.shape_factor / din_support_number(kind.gradient_1_m, shaft.yield_strength_Pa));
  limit.total_factor = (limit.notch_effect / kind.size + 1 / kind.roughness - 1) / shaft.treatment_factor;
  limit.reversed_Pa = kind.of_tensile_strength * shaft.tensile_strength_Pa / limit.total_factor;
  limit.sensitivity = limit.reversed_Pa / (2 * shaft.tensile_strength_Pa - limit.reversed_Pa);
  return limit;
}

/// Share of the equivalent amplitude below which a kind of stress counts its mean in proportion.
constexpr double least_share = 0.01;

double endured_amplitude(const DinLimit& limit, double yield_Pa, double amplitude_Pa, double mean_Pa,
                         double least_Pa, DinLoadCase load_case) {
  if (load_case == DinLoadCase::constant_mean)
    return std::max(0.0, std::min(limit.reversed_Pa - limit.sensitivity * mean_Pa, yield_Pa - mean_Pa));
  if (amplitude_Pa == 0) return 0;
  const double ratio = mean_Pa / std::max(amplitude_Pa, least_Pa);
  return std::min(limit.reversed_Pa / (1 + limit.sensitivity * ratio), yield_Pa / (1 + ratio));
}

double share_of_limit(double stress_Pa, double limit_Pa) {
  if (stress_Pa == 0) return 0;
  return limit_Pa > 0 ? stress_Pa / limit_Pa : std::numeric_limits<double>::infinity();
}

/// Safety of stresses that add up in phase.
double din_safety_of(const DinTriple& stress_Pa, const DinTriple& limit_Pa) {
  return 1 / std::hypot(share_of_limit(stress_Pa.tension, limit_Pa.tension) +
                            share_of_limit(stress_Pa.bending, limit_Pa.bending),
                        share_of_limit(stress_Pa.torsion, limit_Pa.torsion));
}

void require_triple(const std::string& name, const DinTriple& triple, double least) {
  const auto require = [&](const char* kind, double value) {
    require_finite_input(name + "." + kind, value);
    if (value < least)
      refuse_fatigue_input(name + "." + kind, value,
                           least == 0 ? "must not be negative" : "must be at least 1");
  };
  require("tension", triple.tension);
  require("bending", triple.bending);
  require("torsion", triple.torsion);
}

void require_shaft(const DinShaft& shaft) {
  require_positive_input("tensile_strength_Pa", shaft.tensile_strength_Pa);
  require_positive_input("yield_strength_Pa", shaft.yield_strength_Pa);
  if (shaft.yield_strength_Pa > shaft.tensile_strength_Pa)
    refuse_fatigue_input("yield_strength_Pa", shaft.yield_strength_Pa,
                         "must not be above tensile_strength_Pa");
  require_positive_input("treatment_factor", shaft.treatment_factor);
  require_triple("shape_factor", shaft.shape_factor, 1);
  require_triple("gradient_1_m", shaft.gradient_1_m, 0);
}

}  // namespace

double din_size_factor(double diameter_m) {
  require_positive_input("diameter_m", diameter_m);
  const double d_mm = std::clamp(diameter_m * 1e3, 7.5, 150.0);
  return 1 - 0.2 * std::log10(d_mm / 7.5) / std::log10(20.0);
}

double din_roughness_factor(double roughness_m, double tensile_strength_Pa) {
  require_positive_input("roughness_m", roughness_m);
  require_positive_input("tensile_strength_Pa", tensile_strength_Pa);
  const double of_roughness = std::max(0.0, std::log10(roughness_m * 1e6));
  const double of_strength = std::max(0.0, std::log10(tensile_strength_Pa / 20e6) - 1);
  const double factor = 1 - 0.22 * of_roughness * of_strength;
  if (factor < 0.1)
    refuse_fatigue_input("roughness_m", roughness_m,
                         "is too rough for this strength: the roughness factor falls below 0.1");
  return factor;
}

double din_support_number(double gradient_1_m, double yield_strength_Pa) {
  require_non_negative_input("gradient_1_m", gradient_1_m);
  require_positive_input("yield_strength_Pa", yield_strength_Pa);
  return 1 + std::sqrt(gradient_1_m * 1e-3) * std::pow(10, -(0.33 + yield_strength_Pa / 712e6));
}

DinSafety din_743_safety(const DinShaft& shaft, const DinLoad& load) {
  require_shaft(shaft);
  require_triple("amplitude_Pa", load.amplitude_Pa, 0);
  require_finite_input("mean_Pa.tension", load.mean_Pa.tension);
  require_finite_input("mean_Pa.bending", load.mean_Pa.bending);
  require_finite_input("mean_Pa.torsion", load.mean_Pa.torsion);
  const double size = din_size_factor(shaft.diameter_m);
  const double roughness = din_roughness_factor(shaft.roughness_m, shaft.tensile_strength_Pa);
  const DinTriple& alpha = shaft.shape_factor;
  const DinTriple& gradient = shaft.gradient_1_m;
  const bool solid = shaft.section == DinSection::solid;

  DinSafety safety;
  const double yield_Pa = shaft.yield_strength_Pa;  // static support K_2F: table 3
  safety.yield_Pa = {constraint_of_notch(alpha.tension) * yield_Pa,
                     constraint_of_notch(alpha.bending) * (solid ? 1.2 : 1.1) * yield_Pa,
                     (solid ? 1.2 : 1.0) * yield_Pa / std::sqrt(3.0)};
  const double normal_Pa = std::max(0.0, load.mean_Pa.tension + load.mean_Pa.bending);
  safety.mean_equivalent_Pa = std::hypot(normal_Pa, std::sqrt(3.0) * load.mean_Pa.torsion);
  const double mean_Pa = safety.mean_equivalent_Pa;
  const DinTriple& a = load.amplitude_Pa;
  const double least_Pa = least_share * std::hypot(a.tension + a.bending, std::sqrt(3.0) * a.torsion);

  const auto fill = [&](double DinTriple::*kind, const DinKind& of, double mean_of_kind_Pa,
                        double least_of_kind_Pa) {
    const DinLimit limit = limit_of_kind(of, shaft);
    safety.notch_effect.*kind = limit.notch_effect;
    safety.total_factor.*kind = limit.total_factor;
    safety.reversed_Pa.*kind = limit.reversed_Pa;
    safety.sensitivity.*kind = limit.sensitivity;
    safety.amplitude_Pa.*kind = endured_amplitude(limit, safety.yield_Pa.*kind, load.amplitude_Pa.*kind,
                                                  mean_of_kind_Pa, least_of_kind_Pa, load.load_case);
  };
  fill(&DinTriple::tension, {0.4, alpha.tension, gradient.tension, 1, roughness}, mean_Pa, least_Pa);
  fill(&DinTriple::bending, {0.5, alpha.bending, gradient.bending, size, roughness}, mean_Pa, least_Pa);
  fill(&DinTriple::torsion, {0.3, alpha.torsion, gradient.torsion, size, 0.575 * roughness + 0.425},
       mean_Pa / std::sqrt(3.0), least_Pa / std::sqrt(3.0));

  safety.fatigue = din_safety_of(load.amplitude_Pa, safety.amplitude_Pa);
  const DinTriple& m = load.mean_Pa;
  safety.yielding = din_safety_of(
      {a.tension + std::abs(m.tension), a.bending + std::abs(m.bending), a.torsion + std::abs(m.torsion)},
      safety.yield_Pa);
  return safety;
}

}  // namespace pipelines
