#include "pipelines/base/fatigue/endurance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

double share_of_normal_stress(const GroupConstants& group, StressKind kind) {
  return kind == StressKind::normal ? 1 : group.f_W_tau;
}

/// z with Phi(z) = probability >= 0.5: Newton's method on the complementary error function.
double normal_deviate(double probability) {
  double z = 0;
  for (int i = 0; i < 60; ++i) {
    const double tail = std::erfc(z / std::sqrt(2.0)) / 2;
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * pi);
    const double step = (tail - (1 - probability)) / density;
    z += std::min(step, 1.0);
    if (std::abs(step) < 1e-14) break;
  }
  return z;
}

}  // namespace

double support_factor(const FatigueMaterial& material, StressKind kind, double gradient_1_m) {
  require_sound(material);
  require_non_negative_input("gradient_1_m", gradient_1_m);
  const GroupConstants& group = constants_of(material.group);
  const double per_mm = std::min(gradient_1_m * 1e-3, 100.0);
  const double strength_MPa = share_of_normal_stress(group, kind) * material.tensile_strength_Pa / 1e6;
  const double scale = std::pow(10, -(group.a_G + strength_MPa / group.b_G_MPa));
  if (per_mm <= 0.1) return 1 + per_mm * std::sqrt(10.0) * scale;
  return 1 + std::pow(per_mm, per_mm <= 1 ? 0.5 : 0.25) * scale;
}

double roughness_factor(const FatigueMaterial& material, StressKind kind, double roughness_m) {
  require_sound(material);
  require_positive_input("roughness_m", roughness_m);
  require_input_between("roughness_m", roughness_m, 0, 1e-3);
  const GroupConstants& group = constants_of(material.group);
  const double a_R = share_of_normal_stress(group, kind) * group.a_R_sigma;
  const double of_roughness = std::max(0.0, std::log10(roughness_m * 1e6));
  const double of_strength =
      std::max(0.0, std::log10(2 * material.tensile_strength_Pa / 1e6 / group.R_m_N_min_MPa));
  const double factor = 1 - a_R * of_roughness * of_strength;
  if (factor < 0.1)
    refuse_fatigue_input("roughness_m", roughness_m,
                         "is too rough for this strength: the roughness factor falls below 0.1");
  return factor;
}

EnduranceLimit endurance_limit(const FatigueMaterial& material, StressKind kind, double gradient_1_m,
                               const SurfaceState& surface, const CyclicStress& stress,
                               double safety_factor) {
  require_input_between("treatment_factor", surface.treatment_factor, 0.5, 3);
  require_input_between("coating_factor", surface.coating_factor, 0.3, 1);
  require_input_between("grey_iron_factor", surface.grey_iron_factor, 1, 1.1);
  require_input_between("safety_factor", safety_factor, 1, 10);
  const GroupConstants& group = constants_of(material.group);
  const double share = share_of_normal_stress(group, kind);
  EnduranceLimit limit;
  limit.support = support_factor(material, kind, gradient_1_m);
  limit.roughness = roughness_factor(material, kind, surface.roughness_m);
  limit.design_factor =
      (1 + (1 / limit.roughness - 1) / group.K_f_estimate) /
      (limit.support * surface.treatment_factor * surface.coating_factor * surface.grey_iron_factor);
  limit.reversed_Pa = share * reversed_strength_Pa(material) / limit.design_factor;
  limit.mean_stress_sensitivity =
      mean_stress_sensitivity(material.tensile_strength_Pa, group.a_M, group.b_M, share);
  CyclicStress counted = stress;
  if (kind == StressKind::shear) counted.mean_Pa = std::abs(stress.mean_Pa);
  limit.mean_stress_factor = haigh_factor(counted, limit.mean_stress_sensitivity);
  limit.amplitude_Pa = limit.mean_stress_factor * limit.reversed_Pa;
  limit.utilisation = stress.amplitude_Pa * safety_factor / limit.amplitude_Pa;
  return limit;
}

double required_safety(const FatigueMaterial& material, Consequences consequences, Inspection inspection,
                       Casting casting) {
  require_sound(material);
  const GroupConstants& group = constants_of(material.group);
  if (group.is_cast && casting == Casting::not_cast)
    throw std::invalid_argument(std::string("casting = not cast: ") + group.name +
                                " is cast; say whether every part is tested");
  if (!group.is_cast && casting != Casting::not_cast)
    throw std::invalid_argument(std::string("casting = tested or untested: ") + group.name + " is not cast");
  const bool severe = consequences == Consequences::severe;
  double safety = inspection == Inspection::regular ? (severe ? 1.35 : 1.2) : (severe ? 1.5 : 1.3);
  if (casting == Casting::tested) safety *= 1.25;
  if (casting == Casting::untested) safety *= 1.4;
  if (group.is_grey_or_malleable) return safety + 0.5;
  const bool is_checked = material.elongation || material.group == MaterialGroup::ductile_cast_iron;
  const double elongation = material.elongation.value_or(0);
  if (is_checked && elongation < 0.125) safety += 0.5 - std::sqrt(elongation / 0.5);
  return safety;
}

double marin_reliability_factor(double reliability) {
  require_input_between("reliability", reliability, 0.5, 0.999999);
  return 1 - 0.08 * normal_deviate(reliability);
}

double reliability_factor_of_97_5(double reliability) {
  return marin_reliability_factor(reliability) / marin_reliability_factor(0.975);
}

}  // namespace pipelines
