#include "pipelines/write/parts/fatigue_assumptions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/life/fatigue_rules.h"
#include "pipelines/judge/texts/life_text.h"

namespace pipelines {
namespace {

/// A factor that differs less from one is told as none.
constexpr double same_strength = 0.005;

/// Empty where it has one.
std::string why_no_din_743(const FatigueRules& rules, const Judged& analysis) {
  if (!is_din_steel(rules.group()))
    return fmt::format("it is for rolled and forged steel, not for {}", rules.group().name);
  if (analysis.scene.shaft() == nullptr) return "it is for shafts of round solid sections";
  if (!analysis.diagrams)
    return fmt::format("a run with method {} has no resultants of the sections", to_string(analysis.method));
  if (!has_din_fillet(analysis.scene.shaft()->geometry))
    return "the shaft has no fillet between solid segments";
  return "";
}

bool is_as_strong(const SizeOfMaterial& size) {
  return std::abs(size.tensile_factor - 1) < same_strength;
}

/// "0.857 for quenched and tempered steel (sample 16 mm): safety 1.03, 2.1e+03 h".
std::string size_text(const LifeAtSize& at_size) {
  const auto& size = at_size.size;
  auto text =
      fmt::format("{:.3g} for {} (sample {:.0f} mm)", size.tensile_factor, size.name, 1e3 * size.reference_m);
  if (is_as_strong(size)) return text;
  return text + fmt::format(": safety {}, {}", std::isfinite(at_size.safety) ? fixed(at_size.safety, 2) : "-",
                            life_text(at_size.life_s));
}

}  // namespace

std::string strength_text(const Scene& of_run, const Judged& analysis) {
  const FatigueRules rules(analysis.scene.fatigue.value());
  const auto& scene = rules.scene();
  const bool size_is_given = std::none_of(
      of_run.defaults.begin(), of_run.defaults.end(),
      [&](const DefaultUsed& used) { return used.key == analysis.scene.name + ".fatigue.size_factor"; });
  const auto& fatigue = *analysis.fatigue;
  const double tensile_MPa = scene.material.tensile_strength_Pa / 1e6;
  auto text =
      "fatigue strength: " +
      (!scene.strength_source.empty() && scene.size_factor == 1
           ? fmt::format("R_m {:.0f} MPa of the part at its size: {}", tensile_MPa, scene.strength_source)
       : size_is_given
           ? fmt::format("R_m {:.0f} MPa of the part at its size, {:.0f} MPa times size_factor {:.3g}",
                         tensile_MPa, tensile_MPa / scene.size_factor, scene.size_factor)
           : fmt::format("R_m {:.0f} MPa, taken as that of the part at its size (no size_factor)",
                         tensile_MPa));
  text += fmt::format("; surface R_z {:.4g} um (K_R {:.3f}), survival {:.8g} %, safety factor {:.3g}",
                      scene.roughness_m * 1e6, rules.limit(0, {}).roughness, 100 * scene.reliability,
                      scene.safety);
  if (scene.endurance_Pa)
    text += fmt::format("; endurance_limit {:.0f} MPa, as it is", *scene.endurance_Pa / 1e6);
  if (size_is_given || fatigue.at_size.empty()) return text;
  text += fmt::format("; were R_m that of the standard's sample, FKM's K_d at d_eff {:.3g} mm would be ",
                      1e3 * fatigue.effective_diameter_m);
  for (std::size_t i = 0; i < fatigue.at_size.size(); ++i)
    text += (i > 0 ? ", " : "") + size_text(fatigue.at_size[i]);
  const auto& least = fatigue.at_size.back().size;
  if (is_as_strong(least)) return text;
  return text +
         fmt::format(" at {}: then set size_factor = {:.3g} in [{}.fatigue] (yield_strength: times {:.3g})",
                     fatigue.places.front().feature, least.tensile_factor, analysis.scene.name,
                     least.yield_factor);
}

std::vector<std::string> fatigue_assumptions(const Judged& analysis) {
  const FatigueRules rules(analysis.scene.fatigue.value());
  const auto& scene = rules.scene();
  const auto limit = rules.limit(0, {});
  std::vector<std::string> lines;
  const auto size =
      scene.size_factor == 1
          ? scene.strength_source.empty() ? std::string("of the part at its size: size_factor 1")
                                          : "of the part at its size: " + scene.strength_source
          : fmt::format("{:.0f} MPa by size_factor {:.3g}",
                        scene.material.tensile_strength_Pa / scene.size_factor / 1e6, scene.size_factor);
  lines.push_back(
      fmt::format("FKM, local stresses, {}: R_m {:.0f} MPa ({}), reversed limit {:.1f} MPa with R_z {:.4g} "
                  "um (K_R {:.3f}), "
                  "treatment {:.3g}, survival {:.8g} %",
                  rules.group().name, scene.material.tensile_strength_Pa / 1e6, size, limit.reversed_Pa / 1e6,
                  scene.roughness_m * 1e6, limit.roughness, scene.treatment, 100 * scene.reliability));
  lines.push_back(
      fmt::format("safety factor {:.3g} ({}); mean-stress sensitivity {:.3f}; S-N slope {:.3g}, knee at "
                  "{:.0e} cycles",
                  scene.safety, scene.safety_reason, limit.mean_stress_sensitivity, rules.group().slope,
                  rules.group().knee_cycles));
  lines.emplace_back(
      "amplitude: half the von Mises stress of the difference of two instants; mean: signed von Mises stress "
      "of their middle, by FKM's Haigh diagram at constant stress ratio (F2)");
  const auto& second = rules.group().second_slope;
  lines.push_back(fmt::format(
      "cycles by rainflow along the direction of most damage; Palmgren-Miner, damage sum 1, {}",
      second ? fmt::format("S-N slope {:.3g} behind the knee", *second)
             : std::string("elementary: beside a cycle above the knee all others count by the same slope")));
  const double shear = rules.group().f_W_tau;
  lines.push_back(shear > 0.5 && shear < 1
                      ? fmt::format("Findley with tau_W / sigma_W {:.3f}", shear)
                      : fmt::format("no Findley: tau_W / sigma_W {:.3f} is outside 0.5 to 1", shear));
  if (scene.endurance_Pa)
    lines.push_back(
        fmt::format("the smooth specimen's limit is the scene's, {:.1f} MPa", *scene.endurance_Pa / 1e6));
  const bool of_chamber =
      std::holds_alternative<ChamberShape>(analysis.scene.shape) && !analysis.hot_spots.empty();
  if (!analysis.hot_spots.empty())
    lines.push_back(fmt::format(
        "weld toes: IIW, structural hot-spot stress, FAT {:.0f}{} / gamma_M {:.3g}, 95 % survival, "
        "as welded; range of the principal stress within 60 degrees of the toe's normal; "
        "thickness factor f(t) = (25 mm / t)^n above 25 mm",
        scene.toes.class_Pa / 1e6, scene.toes.type.empty() ? "" : " (" + scene.toes.type + ")",
        scene.toes.partial_factor));
  if (!analysis.hot_spots.empty()) {
    const auto one = weld_curve({scene.toes.class_Pa}, LoadAmplitude::constant),
               several = weld_curve({scene.toes.class_Pa}, LoadAmplitude::variable);
    lines.push_back(fmt::format(
        "  Palmgren-Miner, S-N slope {:.3g}, knee at {:.0e} cycles; behind it {:.3g} and damage sum 1 with "
        "one "
        "cycle a period, {:.3g} and damage sum {:.3g} with several",
        one.slope, one.knee_cycles, *one.second_slope, *several.second_slope, damage_sum_of_spectra));
  }
  if (of_chamber)
    lines.emplace_back(
        "  of webs and lugs on the tube; welds of webs on the housing, of lugs on pads and of flanges on the "
        "tube are not judged");
  if (of_chamber && scene.toes.type == "load-carrying")
    lines.emplace_back(
        "  load-carrying fillet welds: webs carry the load from the housings to the tube, lugs that of the "
        "springs; another type of a toe stands in [[chamber.fatigue.welds.toes]]");
  if (!analysis.mesh.notches.empty())
    lines.push_back(fmt::format(
        "weld edges rounded by {:.3g} mm: IIW, effective notch stress, FAT {:.0f} / gamma_M {:.3g}, 95 % "
        "survival, "
        "as welded; range of the principal stress within 60 degrees across the weld; no thickness factor; "
        "slopes and "
        "damage sum as of toes; a mild notch, of less than 1.6 times the structural stress, endures less",
        1e3 * analysis.mesh.notches.front().radius_m,
        fat_of_notch_Pa(analysis.mesh.notches.front().radius_m) / 1e6, scene.toes.partial_factor));
  if (const auto reason = why_no_din_743(rules, analysis); !reason.empty())
    lines.push_back("DIN 743 gives no second opinion: " + reason);
  if (analysis.method == Method::beam)
    lines.push_back("a beam knows no stress gradient: no support by it is counted (n_sigma 1)");
  return lines;
}

}  // namespace pipelines
