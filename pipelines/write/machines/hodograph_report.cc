#include "pipelines/write/machines/hodograph_report.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/loads/stage/load_stage.h"

namespace pipelines {
namespace {

using HodographJson = nlohmann::ordered_json;
using kinetics::PlanetaryHodograph;

/// A figure that follows from the machine's parameters.
struct DerivedFigure {
  const char *name, *unit, *meaning;
  double value = 0;
};

/// (1)-(13). Of a machine without charge nothing is told of it.
std::vector<DerivedFigure> derived_figures(const kinetics::PlanetaryMill& mill) {
  const auto g = kinetics::planetary_geometry(mill);
  const double omega_rad_s = mill.speed_rad_s;
  std::vector<DerivedFigure> figures{
      {"l_OA", "m", "carrier", g.carrier_m},
      {"r_O", "m", "central pulley", g.central_pulley_m},
      {"r_A", "m", "pulley on the drum", g.drum_pulley_m},
      {"k", "1", "r_A / (l_OA + r_A), (6)", g.drum_pulley_m / (g.carrier_m + g.drum_pulley_m)},
      {"b", "1", "r_b / r_A, (7)", mill.drum_radius_m / g.drum_pulley_m},
      {"c", "1", "r_A / r_O, (8)", g.drum_pulley_m / g.central_pulley_m},
      {"v_A", "m/s", "speed of the drum's axis, (2)", omega_rad_s * g.carrier_m},
      {"omega", "rad/s", "spin of the drum with its sign, (1), (4)", omega_rad_s * g.drum_speed_ratio},
      {"sin_beta", "1", "inclination of the strands with its sign, (5)", g.belt_sine},
      {"Phi_A", "N", "inertia of the drum, (9)",
       mill.drum_mass_kg * omega_rad_s * omega_rad_s * g.carrier_m}};
  const auto& charge = mill.charge;
  if (!charge.filling && !charge.void_fraction && !charge.half_angle_rad) return figures;
  const auto body = kinetics::planetary_charge_body(mill);
  const bool is_consistent = mill.convention == kinetics::PlanetaryConvention::consistent;
  const double offset_rad_s = omega_rad_s * (is_consistent ? 1 : g.drum_speed_ratio);
  const double area_m2 = pi * mill.drum_radius_m * mill.drum_radius_m * body.filling;
  for (const DerivedFigure& figure :
       {DerivedFigure{"Phi_C_e", "N", "transport inertia of the charge, (10)",
                      body.mass_kg * omega_rad_s * omega_rad_s * g.carrier_m},
        {"Phi_C_r", "N",
         is_consistent ? "inertia of the charge's offset, m_C Omega^2 l_AC; replaces (11)"
                       : "relative inertia of the charge, (11)",
         body.first_moment_kg_m * offset_rad_s * offset_rad_s},
        {"l_AC", "m", "from the drum's axis to the charge's centroid, (12)", body.centroid_m},
        {"S", "m2", "area of the charge's segment, S' of (13)", area_m2},
        {"filling", "1", "S' / S_b, (13)", body.filling},
        {"m_C", "kg", "mass of the charge", body.mass_kg}})
    figures.push_back(figure);
  return figures;
}

double in_degrees(double angle_rad) {
  const double angle = std::fmod(angle_rad * 180 / pi, 360);
  return angle < 0 ? angle + 360 : angle;
}

HodographJson json_of_component(const PlanetaryHodograph::Component& component) {
  return {{"mean_N", component.mean_N},
          {"cosine_N", component.cosine_N},
          {"sine_N", component.sine_N},
          {"amplitude_N", component.amplitude_N()}};
}

HodographJson hodograph_json(const PlanetaryHodograph& h) {
  return {{"X_A", json_of_component(h.X_A)},
          {"Y_A", json_of_component(h.Y_A)},
          {"R_A",
           {{"largest_N", h.R_max_N},
            {"phi_of_largest_rad", h.phi_of_R_max_rad},
            {"least_N", h.R_min_N},
            {"phi_of_least_rad", h.phi_of_R_min_rad},
            {"mean_N", h.R_mean_N},
            {"amplitude_N", h.R_amplitude_N},
            {"phase_rad", h.R_phase_rad}}}};
}

void print_ellipse(std::ostream& out, const PlanetaryHodograph& h) {
  out << fmt::format("\n  {:<6}{:>14}{:>14}{:>14}{:>14}   mean + cosine cos(phi) + sine sin(phi), N\n", "",
                     "mean", "cosine", "sine", "amplitude");
  for (const auto& [name, part] : {std::pair("X_A", h.X_A), {"Y_A", h.Y_A}})
    out << fmt::format("  {:<6}{:>14.6f}{:>14.6f}{:>14.6f}{:>14.6f}\n", name, part.mean_N,
                       part.cosine_N + 0.0, part.sine_N + 0.0, part.amplitude_N());
  out << fmt::format(
      "  R_A   largest {:.8g} N at phi = {:.2f} deg, least {:.8g} N at {:.2f} deg\n"
      "        to first order {:.8g} + {:.6g} cos(phi - {:.2f} deg) N\n",
      h.R_max_N, in_degrees(h.phi_of_R_max_rad), h.R_min_N, in_degrees(h.phi_of_R_min_rad), h.R_mean_N,
      h.R_amplitude_N, in_degrees(h.R_phase_rad));
}

const char* const no_ellipse =
    "no closed form: T1 - T2 changes its sign in a turn, and the strands swap; `loads --statistics` samples "
    "it";

}  // namespace

void print_hodograph(std::ostream& out, const Scene& scene, bool json) {
  const auto& mill = std::get<kinetics::PlanetaryMill>(scene.machine);
  const auto window = load_stage(scene, scene.machine);
  const auto ellipse =
      with_place(scene.machine_origin, [&] { return kinetics::hodograph(mill, scene.kinetics_effects()); });
  const auto figures = derived_figures(mill);
  const auto& R_N = window.quantity("R_A").values;
  auto warnings = scene.warnings;
  warnings.insert(warnings.end(), window.warnings.begin(), window.warnings.end());
  if (json) {
    HodographJson list;
    for (const auto& figure : figures)
      list["parameters"][figure.name] = {{"value", figure.value}, {"unit", figure.unit}};
    list["hodograph"] = ellipse ? hodograph_json(*ellipse) : HodographJson(no_ellipse);
    list["window"]["R_A"] = {{"largest_N", R_N.maxCoeff()}, {"least_N", R_N.minCoeff()}};
    list["warnings"] = warnings;
    out << list.dump(2) << '\n';
    return;
  }
  out << fmt::format("\n{}: the load on the axle, (X_A, -Y_A), over a turn of the carrier\n\n", scene.title);
  for (const auto& figure : figures)
    out << fmt::format("  {:<10}{:>14.7g} {:<6} {}\n", figure.name, figure.value,
                       figure.unit == std::string("1") ? "" : figure.unit, figure.meaning);
  if (ellipse)
    print_ellipse(out, *ellipse);
  else
    out << "\n  " << no_ellipse << '\n';
  out << fmt::format("  in the scene's window R_A lies between {:.8g} and {:.8g} N\n", R_N.minCoeff(),
                     R_N.maxCoeff());
  for (const auto& warning : warnings) out << "  warning: " << warning << '\n';
}

}  // namespace pipelines
