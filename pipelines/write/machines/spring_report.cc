#include "pipelines/write/machines/spring_report.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>

#include "kinetics/spring_choice.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/loads/stage/load_stage.h"

namespace pipelines {
namespace {

using kinetics::SpringAim;
using kinetics::SpringChoice;
using kinetics::SpringSearch;
using Json = nlohmann::ordered_json;

const kinetics::VibratoryMill& mill_with_springs(const Scene& scene) {
  if (const auto* mill = std::get_if<kinetics::VibratoryMill>(&scene.machine)) return *mill;
  throw StageRefused(scene.machine_type_at +
                     ": springs needs a scene whose machine.type is \"vibratory_mill\"");
}

/// What `loads` warns of: with the given springs, and of the scene itself.
std::vector<std::string> warnings_beside_springs(const Scene& scene) {
  auto warnings = load_stage(scene, scene.machine).warnings;
  warnings.insert(warnings.end(), scene.warnings.begin(), scene.warnings.end());
  if (scene.run_up)
    warnings.push_back(fmt::format(
        "springs are chosen for steady running at {:.4g} rpm; the scene's run-up is not looked at, with the "
        "resonances that it passes: run `loads` with these springs",
        scene.vibratory_mill().speed_rad_s * 30 / pi));
  return warnings;
}

std::string in_Hz(const kinetics::PitchResonance& resonance) {
  return fmt::format("{:.4g} Hz", resonance.frequency_rad_s / (2 * pi));
}

std::string kN_per_m(double stiffness_N_m) {
  return fmt::format("{:.4g} kN/m", stiffness_N_m / 1e3);
}

/// A bound of the scales, and what sets it; empty: nothing does but the end of the search.
struct SpringBound {
  double scale = 0;
  std::string set_by;
};

struct SpringWindow {
  SpringBound least, most;
};

SpringWindow whole_search() {
  const SpringSearch search;
  return {{search.least_scale, ""}, {search.most_scale, ""}};
}

/// The natural frequency goes with the root of the scale. The given springs are within, however near.
/// @param resonances  by rising scale
SpringWindow between_neighbours(const std::vector<kinetics::PitchResonance>& resonances) {
  SpringWindow window = whole_search();
  const auto distance = [](const kinetics::PitchResonance& r) {
    return fmt::format("{:.0f} % from the resonance of the pitch at {}", 100 * resonance_distance, in_Hz(r));
  };
  for (const auto& r : resonances) {
    if (r.scale < 1) {
      window.least = {r.scale / std::pow(1 - resonance_distance, 2), distance(r)};
    } else {
      window.most = {r.scale / std::pow(1 + resonance_distance, 2), distance(r)};
      break;
    }
  }
  const std::string given = "the given springs, nearer than ";
  if (window.least.scale > 1) window.least = {1, given + window.least.set_by};
  if (window.most.scale < 1) window.most = {1, given + window.most.set_by};
  return window;
}

void narrow(SpringWindow& window, const SpringLimits& limits, double given_N_m) {
  const auto past = [](const char* option, double stiffness_N_m, const SpringBound& bound) {
    throw OptionError(fmt::format(
        "{} {}: leaves no springs, since the search ends at {:.4g} times the given ones ({}); "
        "--across-resonances goes farther",
        option, kN_per_m(stiffness_N_m), bound.scale, bound.set_by.empty() ? "its end" : bound.set_by));
  };
  if (limits.least_N_m) {
    const double scale = *limits.least_N_m / given_N_m;
    if (scale >= window.most.scale) past("--least", *limits.least_N_m, window.most);
    if (scale > window.least.scale) window.least = {scale, "--least"};
  }
  if (limits.most_N_m) {
    const double scale = *limits.most_N_m / given_N_m;
    if (scale <= window.least.scale) past("--most", *limits.most_N_m, window.least);
    if (scale < window.most.scale) window.most = {scale, "--most"};
  }
}

/// What is found out for one scene.
struct SpringStudy {
  double given_N_m = 0, weight_N = 0;
  bool has_pitch = false;
  SpringLimits limits;
  SpringWindow window;
  SpringChoice rms, peak;
  SpringChoice rms_anywhere;  ///< without limits

  double sag_m(const SpringChoice& choice) const { return weight_N / choice.stiffness_N_m; }
  /// A bound that the springs lie at; null: none.
  const SpringBound* bound_of(const SpringChoice& choice) const {
    constexpr double same = 1e-5;
    for (const auto* bound : {&window.least, &window.most})
      if (std::abs(choice.scale / bound->scale - 1) < same) return bound;
    return nullptr;
  }
  bool is_at_transmitted(const SpringChoice& choice) const {
    constexpr double same = 1e-3;
    return limits.most_transmitted_N && choice.transmitted_N > (1 - same) * *limits.most_transmitted_N;
  }
  bool is_better_beyond() const {
    constexpr double counts = 0.99;
    const auto& most = rms_anywhere;
    return most.reaction_N < counts * rms.reaction_N &&
           (most.scale < window.least.scale || most.scale > window.most.scale);
  }
};

SpringStudy study_springs(const Scene& scene, const SpringLimits& limits) {
  const auto& mill = mill_with_springs(scene);
  const auto effects = scene.kinetics_effects();
  const auto choose = [&](SpringAim aim, const SpringSearch& search) {
    return kinetics::choose_springs(mill, effects, scene.sampling, aim, search);
  };
  SpringStudy study;
  study.limits = limits;
  study.has_pitch = scene.has_effect("pitch");
  study.rms_anywhere = choose(SpringAim::rms, {});  // refuses what has no springs to scale
  for (const auto& spring : mill.springs) study.given_N_m += spring.stiffness_N_m.y();
  study.weight_N = mill.gravity_m_s2 * (mill.structure_mass_kg + mill.exciter_mass_kg + mill.charge_mass_kg);
  study.window =
      limits.across_resonances ? whole_search() : between_neighbours(study.rms_anywhere.resonances);
  narrow(study.window, limits, study.given_N_m);
  SpringSearch search;
  search.least_scale = study.window.least.scale;
  search.most_scale = study.window.most.scale;
  if (limits.most_transmitted_N) search.most_transmitted_N = *limits.most_transmitted_N;
  search.bounds_held_pitch = limits.least_N_m || limits.most_N_m || limits.most_transmitted_N;
  study.rms = choose(SpringAim::rms, search);
  study.peak = choose(SpringAim::peak, search);
  return study;
}

Json json_of(const SpringStudy& study, const SpringChoice& choice) {
  Json json{{"stiffness_N_m", choice.stiffness_N_m}, {"scale", choice.scale},
            {"reaction_N", choice.reaction_N},       {"reaction_given_N", choice.reaction_given_N},
            {"transmitted_N", choice.transmitted_N}, {"transmitted_given_N", choice.transmitted_given_N}};
  if (std::isfinite(study.sag_m(choice))) json["static_sag_m"] = study.sag_m(choice);
  if (const auto* bound = study.bound_of(choice)) json["decided_by"] = bound->set_by;
  json["resonances"] = Json::array();
  for (const auto& r : study.rms_anywhere.resonances)
    json["resonances"].push_back({{"scale", r.scale},
                                  {"frequency_rad_s", r.frequency_rad_s},
                                  {"crossed", (r.scale - 1) * (r.scale - choice.scale) < 0}});
  json["warnings"] = choice.warnings;
  return json;
}

Json json_of(const SpringStudy& study, const std::vector<std::string>& warnings) {
  Json json{{"goal", "least reaction of the frame's bearings, all springs scaled alike"}};
  Json& limits = json["limits"];
  for (const auto& [key, bound] :
       {std::pair{"least", study.window.least}, std::pair{"most", study.window.most}})
    limits[key] = {
        {"scale", bound.scale}, {"stiffness_N_m", bound.scale * study.given_N_m}, {"set_by", bound.set_by}};
  limits["transmitted_N"] =
      study.limits.most_transmitted_N ? Json(*study.limits.most_transmitted_N) : Json(nullptr);
  limits["across_resonances"] = study.limits.across_resonances;
  json["rms"] = json_of(study, study.rms);
  json["peak"] = json_of(study, study.peak);
  if (study.is_better_beyond())
    json["beyond"] = {{"scale", study.rms_anywhere.scale},
                      {"stiffness_N_m", study.rms_anywhere.stiffness_N_m},
                      {"rms_reaction_N", study.rms_anywhere.reaction_N}};
  json["warnings"] = warnings;
  return json;
}

void print_limits(std::ostream& out, const SpringStudy& study) {
  out << fmt::format(
      "  goal: the least reaction R_E of the frame's bearings, by RMS and by peak; all springs scaled alike\n"
      "  given: {} in all\n",
      kN_per_m(study.given_N_m));
  const bool is_open = !study.has_pitch && !study.limits.least_N_m && !study.limits.most_N_m &&
                       !study.limits.most_transmitted_N;
  if (is_open)
    out << "  limits: none; without pitch there is no resonance to keep away from\n";
  else
    for (const auto& [word, bound] :
         {std::pair{"least", study.window.least}, std::pair{"most", study.window.most}})
      out << fmt::format("  at {}: {}, {:.3g} times the given: {}\n", word,
                         kN_per_m(bound.scale * study.given_N_m), bound.scale,
                         bound.set_by.empty() ? "the end of the search" : bound.set_by);
  if (study.limits.most_transmitted_N)
    out << fmt::format("  force on the ground: at most {:.5g} N\n", *study.limits.most_transmitted_N);
  std::string open;
  const auto add = [&](bool is_given, const std::string& option) {
    if (!is_given) open += (open.empty() ? "" : ", ") + option;
  };
  add(study.limits.least_N_m.has_value(), "--least \"20 kN/m\"");
  add(study.limits.most_N_m.has_value(), "--most \"200 kN/m\"");
  add(study.limits.most_transmitted_N.has_value(), "--most-transmitted \"500 N\" (force on the ground)");
  if (!open.empty()) out << "  not limited, where you know more: " << open << '\n';
}

void print_choices(std::ostream& out, const SpringStudy& study) {
  out << fmt::format("\n  {:<20}{:>12}{:>13}{:>10}{:>11}{:>17}{:>11}{:>11}\n", "", "kN/m in all",
                     "times given", "R_E N", "(given)", "on the ground N", "(given)", "sag mm");
  for (const auto& [aim, choice] :
       {std::pair{"RMS of R_E least", &study.rms}, std::pair{"peak of R_E least", &study.peak}}) {
    const double sag_mm = 1e3 * study.sag_m(*choice);
    out << fmt::format("  {:<20}{:>12.5g}{:>13.4g}{:>10.5g}{:>11}{:>17.4g}{:>11}{:>11}\n", aim,
                       choice->stiffness_N_m / 1e3, choice->scale, choice->reaction_N,
                       fmt::format("({:.5g})", choice->reaction_given_N), choice->transmitted_N,
                       fmt::format("({:.4g})", choice->transmitted_given_N),
                       std::isfinite(sag_mm) ? fmt::format("{:.3g}", sag_mm) : "-");
    if (study.is_at_transmitted(*choice))
      out << "    decided by --most-transmitted\n";
    else if (const auto* bound = study.bound_of(*choice))
      out << "    decided by the bound: " << (bound->set_by.empty() ? "the end of the search" : bound->set_by)
          << '\n';
    for (const auto& warning : choice->warnings)
      if (warning.find("end of the search") == std::string::npos) out << "    warning: " << warning << '\n';
  }
  out << "  on the ground: largest size of the springs' force without its mean; sag: under the weights of "
         "structure, exciter and charge\n";
}

void print_beyond(std::ostream& out, const SpringStudy& study) {
  const auto& resonances = study.rms_anywhere.resonances;
  if (!resonances.empty()) {
    out << "  resonances of the pitch:";
    const char* between = " ";
    for (const auto& r : resonances) {
      out << between << in_Hz(r) << fmt::format(" at {:.4g} times the given", r.scale);
      between = ", ";
    }
    out << '\n';
  }
  if (!study.is_better_beyond()) return;
  const auto& far = study.rms_anywhere;
  int n_crossed = 0;
  for (const auto& r : resonances)
    if ((r.scale - 1) * (r.scale - far.scale) < 0) ++n_crossed;
  out << fmt::format(
      "  beyond these limits: RMS {:.5g} N with {}, {:.4g} times the given{}{}\n", far.reaction_N,
      kN_per_m(far.stiffness_N_m), far.scale,
      n_crossed > 0 ? fmt::format(", across {} resonance{}", n_crossed, n_crossed > 1 ? "s" : "") : "",
      study.limits.across_resonances ? "" : "; --across-resonances looks there");
}

}  // namespace

void print_spring_choice(std::ostream& out, const Scene& scene, const SpringLimits& limits, bool json) {
  const auto study = study_springs(scene, limits);
  const auto warnings = warnings_beside_springs(scene);
  if (json) {
    out << json_of(study, warnings).dump(2) << '\n';
    return;
  }
  out << '\n' << scene.title << ": springs for the frame's bearings\n";
  print_limits(out, study);
  print_choices(out, study);
  print_beyond(out, study);
  for (const auto& warning : warnings) out << "  warning: " << warning << '\n';
}

}  // namespace pipelines
