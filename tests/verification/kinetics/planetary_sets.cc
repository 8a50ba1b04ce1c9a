#include "tests/verification/kinetics/planetary_sets.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "kinetics/planetary/balance.h"

namespace planetary_sets {

using kinetics::PlanetaryConvention;
using kinetics::PlanetaryMill;
using kinetics::PlanetaryRatios;

namespace {

const double degree = std::acos(-1.0) / 180;

}  // namespace

Json read(const std::string& name) {
  std::ifstream file(std::string(SOURCE_DIR) + "/tests/data/" + name + ".json");
  if (!file) throw std::runtime_error("tests/data/" + name + ".json is missing");
  return Json::parse(file);
}

PlanetaryMill mill_of(const std::string& set, PlanetaryConvention convention) {
  static const Json parameters = read("planetary_mill_figure3")["parameters"];
  const Json& in = parameters.at(set);
  PlanetaryMill mill;
  mill.convention = convention;
  mill.speed_rad_s = in["Omega"];
  mill.drum_radius_m = in["r_drum"];
  mill.drum_length_m = in["length"];
  mill.drum_mass_kg = in["m_A"];
  mill.geometry = PlanetaryRatios{in["k"], in["b"], in["c"]};
  const double volume_m3 = std::acos(-1.0) * mill.drum_radius_m * mill.drum_radius_m * mill.drum_length_m;
  mill.charge.bulk_density_kg_m3 =
      in.contains("rho_bulk") ? in["rho_bulk"].get<double>() : in["m_C_full"].get<double>() / volume_m3;
  mill.charge.half_angle_rad = in["gamma_deg"].get<double>() * degree;
  mill.charge.segment_angle_rad = in["alpha_deg"].get<double>() * degree;
  return mill;
}

PlanetaryConvention convention_named(const std::string& name) {
  if (name == "as_published") return PlanetaryConvention::as_published;
  return name == "as_plotted" ? PlanetaryConvention::as_plotted : PlanetaryConvention::consistent;
}

kinetics::LoadHistory loads_of(PlanetaryMill mill, int n) {
  const auto machine = kinetics::planetary::make_machine(mill);
  std::vector<std::string> names;
  for (const auto& info : kinetics::planetary_mill_effects(mill.convention)) names.push_back(info.name);
  return kinetics::planetary::balance(machine, kinetics::planetary::make_effects(machine, names), {1, n});
}

double R_A_N(PlanetaryMill mill, double phi_deg) {
  mill.initial_angle_rad = phi_deg * degree;
  return loads_of(mill, 4).quantity("R_A").values[0];
}

PlanetaryMill at_abscissa(PlanetaryMill mill, const std::string& figure, double x) {
  auto& ratios = std::get<PlanetaryRatios>(mill.geometry);
  if (figure == "fig6" || figure == "fig7" || figure == "fig8") mill.speed_rad_s = 60;
  if (figure == "fig7" || figure == "fig8") ratios.k = 0.4;
  if (figure == "fig4") mill.speed_rad_s = x;
  if (figure == "fig5") mill.charge.half_angle_rad = x * degree;
  if (figure == "fig6") ratios.k = x;
  if (figure == "fig7") ratios.b = x;
  if (figure == "fig8") ratios.c = x;
  return mill;
}

}  // namespace planetary_sets
