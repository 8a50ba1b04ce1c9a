#include "pipelines/write/machines/mill_reports.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "kinetics/vibratory/torus_extremes.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/loads/channels/load_figures.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/write/machines/hodograph_report.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double angle_rad) {
  return angle_rad * 180 / pi;
}

}  // namespace

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
    out << fmt::format(
        "  warning: least and largest over all angles are of steady running at {:.4g} rpm; the scene's "
        "run-up may exceed them: it has columns of its own\n",
        mill->speed_rad_s * 30 / pi);
}

}  // namespace pipelines
