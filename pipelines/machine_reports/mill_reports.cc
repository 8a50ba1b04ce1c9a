#include "pipelines/machine_reports/mill_reports.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "kinetics/spring_choice.h"
#include "kinetics/vibratory/torus_extremes.h"
#include "pipelines/channels/load_figures.h"
#include "pipelines/common/constants.h"
#include "pipelines/common/errors.h"
#include "pipelines/loads/load_stage.h"
#include "pipelines/machine_reports/hodograph_report.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

const kinetics::VibratoryMill& mill_with_springs(const Scene& scene) {
  if (const auto* mill = std::get_if<kinetics::VibratoryMill>(&scene.machine)) return *mill;
  throw StageRefused(scene.machine_type_at +
                     ": springs needs a scene whose machine.type is \"vibratory_mill\"");
}

/// What `loads` warns of: with the given springs, and of the scene itself.
std::vector<std::string> warnings_of_loads(const Scene& scene) {
  auto warnings = load_stage(scene, scene.machine).warnings;
  warnings.insert(warnings.end(), scene.warnings.begin(), scene.warnings.end());
  return warnings;
}

/// What a scene with a run-up has to be told of figures that are not of it.
std::string steady_only(const Scene& scene, const std::string& what) {
  return fmt::format("{} steady running at {:.4g} rpm; the scene's run-up ", what,
                     scene.vibratory_mill().speed_rad_s * 30 / pi);
}

double degrees(double angle_rad) {
  return angle_rad * 180 / pi;
}

Json json_of(const kinetics::SpringChoice& choice) {
  Json json{{"stiffness_N_m", choice.stiffness_N_m},
            {"scale", choice.scale},
            {"reaction_N", choice.reaction_N},
            {"reaction_given_N", choice.reaction_given_N}};
  for (const auto& r : choice.resonances)
    json["resonances"].push_back({{"scale", r.scale},
                                  {"frequency_rad_s", r.frequency_rad_s},
                                  {"crossed", r.between_given_and_chosen}});
  json["warnings"] = choice.warnings;
  return json;
}

void print_choice(std::ostream& out, const std::string& aim, const kinetics::SpringChoice& choice) {
  out << fmt::format(
      "\n  {} of R_E least: {:.5g} kN/m in all, {:.4g} times the given stiffness\n    {:.5g} N instead of "
      "{:.5g} N\n",
      aim, choice.stiffness_N_m / 1e3, choice.scale, choice.reaction_N, choice.reaction_given_N);
  for (const auto& r : choice.resonances)
    out << fmt::format("    resonance of the pitch at {:.4g} times, {:.4g} Hz{}\n", r.scale,
                       r.frequency_rad_s / (2 * pi),
                       r.between_given_and_chosen ? ": between the given springs and these" : "");
  for (const auto& warning : choice.warnings) out << "    warning: " << warning << '\n';
}

}  // namespace

void print_spring_choice(std::ostream& out, const Scene& scene, bool json) {
  using kinetics::SpringAim;
  const auto& mill = mill_with_springs(scene);
  const auto choice = [&](SpringAim aim) {
    return kinetics::choose_springs(mill, scene.kinetics_effects(), scene.sampling, aim);
  };
  const auto rms = choice(SpringAim::rms), peak = choice(SpringAim::peak);
  auto warnings = warnings_of_loads(scene);
  if (scene.run_up)
    warnings.push_back(
        steady_only(scene, "springs are chosen for") +
        "is not looked at, with the resonances that it passes: run `loads` with these springs");
  if (json) {
    out << Json{{"rms", json_of(rms)}, {"peak", json_of(peak)}, {"warnings", warnings}}.dump(2) << '\n';
    return;
  }
  out << '\n' << scene.title << ": the springs that load the frame's bearings least\n";
  print_choice(out, "RMS", rms);
  print_choice(out, "peak", peak);
  for (const auto& warning : warnings) out << "  warning: " << warning << '\n';
}

void print_extremes(std::ostream& out, const Scene& scene, bool json) {
  if (std::holds_alternative<kinetics::PlanetaryMill>(scene.machine)) {
    print_hodograph(out, scene, json);
    return;
  }
  const auto* mill = std::get_if<kinetics::VibratoryMill>(&scene.machine);
  if (mill == nullptr)
    throw StageRefused(scene.machine_type_at +
                       ": extremes needs a scene whose machine.type is \"vibratory_mill\" or "
                       "\"planetary_mill\"; `loads` lists the extremes of the scene's window");
  const auto window = load_stage(scene, scene.machine);  // a run-up, where the scene has one
  const std::string in = scene.run_up ? "run-up" : "window", key = scene.run_up ? "_in_run_up" : "_in_window";
  const auto extremes = kinetics::torus_extremes(*mill, scene.kinetics_effects());
  const auto course = course_of_loads(scene, window);
  Json list;
  if (!json)
    out << fmt::format(
        "\n{}: extremes over all angles of drive and charge{}\n\n  {:<22}{:>13}{:>13}{:>18}{:>18}\n",
        scene.title, scene.run_up ? " in steady running, beside those of the run-up" : "", "load", "least",
        "largest", "least in " + in, "largest in " + in);
  for (const auto& e : extremes) {
    auto figure = figure_of(e.quantity, e.unit, window.quantity(e.quantity).values, window.time_s);
    take_course(course, figure);
    const auto& of_window = figure.statistics;
    if (json)
      list[e.quantity] = {{"unit", e.unit},
                          {"least", e.least.value},
                          {"largest", e.most.value},
                          {"least" + key, of_window.min},
                          {"largest" + key, of_window.max},
                          {"phi_of_largest_rad", e.most.phi_rad},
                          {"chi_of_largest_rad", e.most.chi_rad}};
    else
      out << fmt::format(
          "  {:<22}{:>13.6g}{:>13.6g}{:>18.6g}{:>18.6g}   largest at phi {:.1f}, chi {:.1f} deg\n",
          e.quantity + " [" + e.unit + "]", e.least.value, e.most.value, of_window.min, of_window.max,
          degrees(e.most.phi_rad), degrees(e.most.chi_rad));
  }
  if (json) out << list.dump(2) << '\n';
  if (!json && scene.run_up)
    out << "  warning: "
        << steady_only(scene, "least and largest over all angles are of") +
               "may exceed them: it has columns of its own\n";
}

}  // namespace pipelines
